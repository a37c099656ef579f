// Walls from PNG files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "bad_scenes.hpp"
#include "clca/image/png.hpp"
#include "clca/scene/parse.hpp"
#include "support/runs.hpp"

namespace clca::scene::picture_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class PictureTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
    std::ofstream(path(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  Scene scene(const std::string& file) const {
    return parse(
        testing::scene_with("walls: {maze: {picture: {file: " + file + ", box: [0, 0, 50, 50]}}}"),
        path("scene.yaml"));
  }
  std::string refusal(const std::string& file) const {
    try {
      scene(file);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  clca::testing::ScratchFolder folder_;
};

TEST_F(PictureTest, DarkPixelsAreWall) {
  image::Image picture(4, 2, {255, 255, 255});
  picture.at(0, 0) = {0, 0, 0};
  picture.at(1, 0) = {127, 127, 127};
  picture.at(2, 0) = {128, 128, 128};
  picture.at(0, 1) = {255, 0, 0};
  picture.at(1, 1) = {0, 255, 0};
  picture.at(2, 1) = {0, 0, 255};
  write("maze.png", image::encode_png(picture, {}));
  const Scene read = scene("maze.png");
  ASSERT_EQ(read.walls.size(), 1U);
  EXPECT_EQ(std::get<lattice::Picture>(read.walls.front().parts.front()),
            (lattice::Picture{.box = {0, 0, 50, 50}, .rows = {"##..", "#.#."}}));
}

TEST_F(PictureTest, TheResolvedSceneNeedsNoFile) {
  write("maze.png", image::encode_png(image::Image(300, 2, {}), {}));
  const Scene read = scene("maze.png");
  std::filesystem::remove(path("maze.png"));
  EXPECT_EQ(testing::reparsed(read), to_yaml(read));
}

TEST_F(PictureTest, WhatIsNoPictureIsRefusedInOneLine) {
  EXPECT_EQ(refusal("gone.png"), path("scene.yaml") +
                                     ":7:32: error: walls.maze.picture.file: cannot read " +
                                     path("gone.png") + ": No such file or directory");
  write("broken.png", {1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_THAT(refusal("broken.png"),
              AllOf(StartsWith(path("scene.yaml") + ":7:32: error: walls.maze.picture.file: "),
                    HasSubstr("cannot read a PNG file")));
  write("large.png", image::encode_png(image::Image(1001, 1000, {}), {}));
  EXPECT_THAT(refusal("large.png"), HasSubstr("too large: 1001 x 1000 pixels"));
  EXPECT_THAT(refusal("."), HasSubstr("it is a folder"));
}

TEST_F(PictureTest, AFileThatIsNamedOftenIsRefusedWhereTheRowsOfAllAreTooLarge) {
  write("large.png", image::encode_png(image::Image(1000, 1000, {}), {}));
  write("narrow.png", image::encode_png(image::Image(1, 300'000, {}), {}));
  const auto refusal_of = [&](const std::string& more) {
    std::string walls;
    for (const std::string name : {"a", "b", "c", "d"}) {
      walls += "  " + name + ": {picture: {file: large.png, box: [0, 0, 50, 50]}}\n";
    }
    try {
      parse(testing::scene_with("walls:\n" + walls + more), path("scene.yaml"));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string at = path("scene.yaml") + ":12:";
  const std::string reason = "error: with this picture the rows of all pictures are larger than ";
  EXPECT_EQ(refusal_of(""), "");
  EXPECT_EQ(refusal_of("  e: {picture: {file: large.png, box: [0, 0, 50, 50]}}\n"),
            at + "23: " + reason + "4 MiB");
  EXPECT_EQ(refusal_of("  e: {parts: [{picture: {file: narrow.png, box: [0, 0, 50, 50]}}]}\n"),
            at + "32: " + reason + "4 MiB");
}

}  // namespace
}  // namespace clca::scene::picture_test
