#include "clca/render/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "clca/render/painter.hpp"
#include "support/missing.hpp"

namespace clca::render::contact_sheet_test {
namespace {

constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kBlue = {0, 0, 200};

struct Box {
  int left = 10000, right = -1, top = 10000, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

Box around(const Image& image, Rgb color) {
  Box box;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == color) {
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
               std::max(box.bottom, y)};
      }
    }
  }
  return box;
}

TEST(ContactSheet, SetsPicturesInRowsAndColumns) {
  std::vector<Tile> tiles;
  for (int i = 0; i < 5; ++i) {
    tiles.push_back(tile(Image(320, 180, {static_cast<std::uint8_t>(10 + i), 200, 0}),
                         {{0, 0, 320, 180}}, 160));
  }
  const Image sheet = contact_sheet(tiles, 3, 160, "");
  std::vector<Box> boxes;
  for (const Tile& item : tiles) {
    boxes.push_back(around(sheet, item.view_image.at(0, 0)));
    EXPECT_EQ(boxes.back().width(), 160);
    EXPECT_EQ(boxes.back().height(), 90);
  }
  EXPECT_EQ(boxes[0].top, boxes[2].top);
  EXPECT_EQ(boxes[3].left, boxes[0].left);
  EXPECT_EQ(boxes[4].left, boxes[1].left);
  const int gap = boxes[1].left - boxes[0].right - 1;
  EXPECT_GT(gap, 5);
  EXPECT_EQ(boxes[2].left - boxes[1].right - 1, gap);
  EXPECT_EQ(boxes[0].left, gap);
  EXPECT_EQ(sheet.width - 1 - boxes[2].right, gap);
  EXPECT_GT(boxes[3].top, boxes[0].bottom + gap);
  EXPECT_EQ(std::count(sheet.pixels.begin(), sheet.pixels.end(), kWhite),
            static_cast<std::ptrdiff_t>(sheet.pixels.size()) - 5 * 160 * 90);
}

TEST(ContactSheet, DrawsAPaleBoxForAMissingPicture) {
  const Image sheet = contact_sheet({{Image(100, 80, kBlue)}, {}}, 2, 100, "");
  const Box there = around(sheet, kBlue);
  const Rgb pale = sheet.at(there.right + 50, there.top + 10);
  EXPECT_NE(pale, kWhite);
  const Box box = around(sheet, pale);
  EXPECT_EQ(box.width(), 100);
  EXPECT_EQ(box.height(), 80);
  EXPECT_EQ(box.top, there.top);
}

TEST(ContactSheet, TakesNoPicturesAndNoneThatIsThere) {
  EXPECT_GT(contact_sheet({}, 4, 100, "Nothing").width, 0);
  const Image sheet =
      contact_sheet({{.label = "a"}, {.label = "b"}, {.label = "c"}}, 2, 100, "All failed");
  EXPECT_GT(sheet.height, 100);
}

TEST(ContactSheet, TakesPicturesOfSeveralSizes) {
  const Image sheet = contact_sheet({tile(Image(10, 40, kBlue), {{0, 0, 10, 40}}, 50),
                                     tile(Image(400, 1, {9, 9, 9}), {{0, 0, 400, 1}}, 50)},
                                    2, 50, "");
  EXPECT_EQ(around(sheet, kBlue).height(), 70);  // no taller than 1.4 widths
  EXPECT_EQ(around(sheet, {9, 9, 9}).height(), 1);
}

TEST(ContactSheet, WritesLabelsUnderPicturesAndATitleAbove) {
  if (const std::string problem = font_warning(); !problem.empty()) {
    CLCA_SKIP_AS_MISSING(problem);
  }
  const auto sheet = [](const std::string& label, const std::string& title) {
    return contact_sheet({{.view_image = Image(200, 100, kBlue), .label = label}}, 1, 200, title);
  };
  const auto ink = [](const Image& image, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y) {
      for (int x = 0; x < image.width; ++x) {
        count += image.at(x, y) != kWhite && image.at(x, y) != kBlue ? 1 : 0;
      }
    }
    return count;
  };
  const Image bare = sheet("", "Sweep");
  const Box place = around(bare, kBlue);
  EXPECT_GT(ink(bare, 0, place.top), 20);
  EXPECT_EQ(ink(bare, place.bottom + 1, bare.height), 0);
  const Image labelled = sheet("friction 0.5", "Sweep");
  EXPECT_EQ(labelled.height, bare.height);
  EXPECT_GT(ink(labelled, place.bottom + 1, labelled.height), 20);
  const Image long_label = sheet(std::string(500, 'w'), std::string(500, 'W'));
  EXPECT_EQ(long_label.width, bare.width);
  EXPECT_EQ(around(sheet("", ""), kBlue).height(), 100);
  const Image several_lines = sheet("wall_friction=0.1, restitution=0.4, seed 3", "Sweep");
  EXPECT_GT(several_lines.height, bare.height);
  EXPECT_GT(ink(several_lines, bare.height - 12, several_lines.height), 20);
}

/// Pictures with a patch of this colour in their legends, and a colour bar to this value.
Tile tile_with(Rgb patch, double high) {
  Image image(100, 80, kWhite);
  for (int y = 10; y < 50; ++y) {
    std::fill(&image.at(10, y), &image.at(90, y), kBlue);
  }
  Tile result = tile(image, {{10, 10, 80, 40}, 4}, 200);
  EXPECT_EQ(result.pixels_per_spacing, 10);
  result.legend.patches = {{.label = "grains", .color = patch}};
  result.legend.bars = {{.label = "load", .high = high}};
  return result;
}

TEST(ContactSheet, HasALegendOnceWhereThatOfAllIsOne) {
  if (const std::string problem = font_warning(); !problem.empty()) {
    CLCA_SKIP_AS_MISSING(problem);
  }
  constexpr Rgb kGreen = {0, 150, 0};
  constexpr Rgb kOrange = {250, 150, 0};
  const Image same = contact_sheet({tile_with(kGreen, 1), tile_with(kOrange, 1), {}}, 3, 200, "");
  const Box pictures = around(same, kBlue);
  EXPECT_EQ(pictures.width(), 2 * 200 + around(same, kBlue).left);
  EXPECT_GT(around(same, kGreen).top, pictures.bottom + 20);
  EXPECT_EQ(around(same, kGreen).top, around(same, kOrange).top);
  EXPECT_LT(around(same, kOrange).left, around(same, kGreen).right + 100) << "both in one legend";
  const Image different =
      contact_sheet({tile_with(kGreen, 1), tile_with(kOrange, 2), {}}, 3, 200, "");
  EXPECT_EQ(around(different, kGreen).top, around(different, kOrange).top);
  EXPECT_LT(around(different, kGreen).right, 200);
  EXPECT_GT(around(different, kOrange).left, 200) << "each below its picture";
}

TEST(ContactSheet, RefusesSizesThatMakeNoSense) {
  EXPECT_THROW(contact_sheet({}, 0, 100, ""), std::invalid_argument);
  EXPECT_THROW(contact_sheet({}, 2, 0, ""), std::invalid_argument);
  EXPECT_THROW(contact_sheet({{Image(1, 1000, kBlue)}}, 1, 100000, ""), RenderError);
  EXPECT_THROW(contact_sheet({}, 2, 2000000000, ""), RenderError);
}

}  // namespace
}  // namespace clca::render::contact_sheet_test
