#include "drawing/space_time.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "clca/drawing/redraw.hpp"
#include "clca/render/coloring.hpp"
#include "clca/run/run.hpp"
#include "drawn_scenes.hpp"
#include "support/runs.hpp"

namespace clca::drawing::space_time_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A line of two places.
Eigen::ArrayXXd line(double low, double high) {
  Eigen::ArrayXXd values(1, 2);
  values << low, high;
  return values;
}

TEST(TimeMeans, HoldsEachLineAsLongAsItLasts) {
  TimeMeans means(10, 2, 1, 100, 200);
  means.add(100, 130, line(1, 5));
  means.add(130, 200, line(2, 6));
  for (int column = 0; column < 10; ++column) {
    EXPECT_NEAR(means.mean(column, 0)[0], column < 3 ? 1 : 2, 1e-12) << column;
    EXPECT_NEAR(means.mean(column, 1)[0], column < 3 ? 5 : 6, 1e-12) << column;
  }
}

TEST(TimeMeans, ManyLinesInAPixelCountByTheirTime) {
  TimeMeans means(2, 2, 1, 0, 20);
  means.add(0, 2, line(1, 0));
  means.add(2, 3, line(4, 0));
  means.add(3, 14, line(10, 0));
  EXPECT_NEAR(means.mean(0, 0)[0], (2 * 1 + 1 * 4 + 7 * 10) / 10.0, 1e-12);
  EXPECT_NEAR(means.mean(1, 0)[0], 10, 1e-12);  // of what is known
}

TEST(TimeMeans, KnowsWhereThereIsNothing) {
  TimeMeans means(4, 2, 1, 0, 4);
  means.add(-5, 2, line(1, 1));
  means.add(4, 4, line(1, 1));
  means.add(4, 9, line(1, 1));
  EXPECT_TRUE(means.is_known(0));
  EXPECT_TRUE(means.is_known(1));
  EXPECT_FALSE(means.is_known(2));
  EXPECT_FALSE(means.is_known(3));
}

scene::Scene falling(const std::vector<scene::Override>& settings) {
  return scene::parse(kFalling, "tried.yaml", settings);
}

class SpaceTimeTest : public ::testing::Test {
 protected:
  SpaceTimeTest() { run::run(run_.scene, {.folder = run_.run_folder}); }

  testing::ScratchFolder folder_;
  RunToDraw run_ = {falling({"output.frames.every=7"}), folder_.path() / "run"};
};

TEST_F(SpaceTimeTest, AColumnOverTimeHoldsEachFrameUntilTheNext) {
  Redraw redraw({run_}, {.space_time = SpaceTimeOptions{
                             .file = folder_.path() / "a.png", .column_x = 10, .slit_width = 20}});
  EXPECT_GT(redraw.draw(), 10U);
  const image::Image image = redraw.space_time_picture().plot_image;
  ASSERT_EQ(image.width, 100);  // a pixel a step
  const auto same = [&](int one, int other) {
    for (int y = 0; y < image.height; ++y) {
      if (image.at(one, y) != image.at(other, y)) {
        return false;
      }
    }
    return true;
  };
  for (int x = 0; x < 56; ++x) {
    EXPECT_TRUE(same(x, x / 7 * 7)) << x;
  }
  EXPECT_FALSE(same(0, 7));
  EXPECT_FALSE(same(7, 14));
  // The table stands until it is removed at step 60. The picture shows y = -0.5 to 61.
  const int table = image.height - 1 - static_cast<int>((8.2 + 0.5) / 61.5 * image.height);
  EXPECT_EQ(image.at(57, table), image.at(0, table));
  EXPECT_NE(image.at(63, table), image.at(0, table));
}

TEST_F(SpaceTimeTest, APictureOverTimeHasAllPicturesWhateverAMovieBesideItShows) {
  const auto space_time = [&](const fs::path& movie, std::optional<double> duration) {
    Redraw redraw({run_},
                  {.movie_file = movie,
                   .frames_per_second = 10,
                   .movie_seconds = duration,
                   .space_time = SpaceTimeOptions{
                       .file = folder_.path() / "column.png", .column_x = 10, .slit_width = 20}});
    redraw.draw();
    return redraw.space_time_picture().plot_image;
  };
  EXPECT_EQ(space_time(folder_.path() / "movie.png", 0.5), space_time("", {}));
}

TEST_F(SpaceTimeTest, TheSurfaceOverTimeIsWhiteWhereThereAreNoGrains) {
  Redraw redraw({run_}, {.space_time = SpaceTimeOptions{.file = folder_.path() / "surface.png"}});
  redraw.draw();
  const image::Image image = redraw.space_time_picture().plot_image;
  const image::Rgb white = {255, 255, 255};
  EXPECT_EQ(image.at(0, 0), white);
  EXPECT_EQ(image.at(0, image.height - 1), white);
  EXPECT_GT(std::count(image.pixels.begin(), image.pixels.end(), render::viridis_color(1)), 0);
}

TEST_F(SpaceTimeTest, WhatCannotBeShownOverTimeIsRefused) {
  const auto refusal = [&](const SpaceTimeOptions& options,
                           const std::vector<scene::Override>& keys, std::uint64_t to = 100) {
    try {
      const Redraw none({{falling(keys), run_.run_folder}},
                        {.space_time = options, .last_step = to});
    } catch (const RedrawError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const fs::path file = folder_.path() / "a.png";
  EXPECT_EQ(refusal({.file = file, .column_x = 10}, {}), "");
  EXPECT_THAT(refusal({.file = folder_.path() / "a.pdf", .column_x = 10}, {}),
              HasSubstr("a.pdf: a picture over time ends in .png"));
  EXPECT_THAT(refusal({.file = file, .column_x = 21}, {}),
              HasSubstr("the column at x = 21 reaches beyond the box in view"));
  EXPECT_THAT(refusal({.file = file, .column_x = 10, .slit_width = 30}, {}),
              HasSubstr("expected a slit above 0 and up to"));
  EXPECT_THAT(refusal({.file = file, .column_x = 1, .slit_width = 10}, {}),
              HasSubstr("beyond the box"));
  EXPECT_THAT(refusal({.file = file, .column_x = 10}, {}, 0),
              HasSubstr("needs frames of two steps"));
  EXPECT_THAT(refusal({.file = file, .column_x = 10}, {"output.frames.color_by=displacement"}),
              HasSubstr("another colour bar in each stage"));
  EXPECT_EQ(refusal({.file = file}, {"output.frames.color_by=displacement"}), "");
  EXPECT_EQ(refusal({.file = file, .column_x = 10}, {"output.frames.color_by=displacement"}, 50),
            "");
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace clca::drawing::space_time_test
