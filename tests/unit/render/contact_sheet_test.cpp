#include "clca/render/contact_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "clca/render/area_filter.hpp"
#include "clca/render/painter.hpp"
#include "support/missing.hpp"

namespace clca::render {
namespace {

constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kBlue = {0, 0, 200};

/// Any picture with many colours.
Image speckled(int width, int height) {
  Image image(width, height, {});
  std::uint32_t value = 7;
  for (Rgb& pixel : image.pixels) {
    value = value * 1664525U + 1013904223U;
    pixel = {static_cast<std::uint8_t>(value >> 24U), static_cast<std::uint8_t>(value >> 16U),
             static_cast<std::uint8_t>(value >> 8U)};
  }
  return image;
}

double mean_red(const Image& image) {
  const double sum = std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0,
                                     [](double before, Rgb pixel) { return before + pixel.red; });
  return sum / static_cast<double>(image.pixels.size());
}

TEST(AreaFilter, KeepsTheMeanOfAPicture) {
  const Image image = speckled(97, 61);
  for (const auto& [width, height] : {std::pair{1, 1}, {13, 7}, {96, 60}, {97, 61}, {150, 200}}) {
    const Image small = scaled(image, width, height);
    EXPECT_EQ(small.width, width);
    EXPECT_EQ(small.height, height);
    EXPECT_NEAR(mean_red(small), mean_red(image), 0.5) << width;
  }
}

TEST(AreaFilter, LeavesThePictureOfItsOwnSizeAlone) {
  const Image image = speckled(20, 30);
  EXPECT_EQ(scaled(image, 20, 30), image);
}

TEST(AreaFilter, TakesTheMeanOfWholeBlocksAndOfParts) {
  Image image(4, 2, {0, 0, 0});
  image.at(0, 0) = {100, 0, 8};
  image.at(1, 1) = {100, 0, 0};
  const Image half = scaled(image, 2, 1);
  EXPECT_EQ(half.at(0, 0), (Rgb{50, 0, 2}));
  EXPECT_EQ(half.at(1, 0), (Rgb{0, 0, 0}));
  Image three(3, 1, {0, 0, 0});
  three.at(1, 0) = {90, 0, 0};
  const Image two = scaled(three, 2, 1);  // each has half of the pixel in the middle
  EXPECT_EQ(two.at(0, 0), (Rgb{30, 0, 0}));
  EXPECT_EQ(two.at(1, 0), (Rgb{30, 0, 0}));
}

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
  std::vector<LabelledImage> images;
  for (int i = 0; i < 5; ++i) {
    images.push_back({Image(320, 180, {static_cast<std::uint8_t>(10 + i), 200, 0}), ""});
  }
  const Image sheet = contact_sheet(images, 3, 160, "");
  std::vector<Box> boxes;
  for (const LabelledImage& item : images) {
    boxes.push_back(around(sheet, item.image.at(0, 0)));
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
  const Image sheet = contact_sheet({{Image(100, 80, kBlue), ""}, {{}, ""}}, 2, 100, "");
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
  const Image sheet = contact_sheet({{{}, "a"}, {{}, "b"}, {{}, "c"}}, 2, 100, "All failed");
  EXPECT_GT(sheet.height, 100);
}

TEST(ContactSheet, TakesPicturesOfSeveralSizes) {
  const Image sheet =
      contact_sheet({{Image(10, 40, kBlue), ""}, {Image(400, 1, {9, 9, 9}), ""}}, 2, 50, "");
  EXPECT_EQ(around(sheet, kBlue).height(), 200);
  EXPECT_EQ(around(sheet, {9, 9, 9}).height(), 1);
}

TEST(ContactSheet, WritesLabelsUnderPicturesAndATitleAbove) {
  if (const std::string problem = font_problem(); !problem.empty()) {
    CLCA_SKIP_AS_MISSING(problem);
  }
  const auto sheet = [](const std::string& label, const std::string& title) {
    return contact_sheet({{Image(200, 100, kBlue), label}}, 1, 200, title);
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
}

TEST(ContactSheet, RefusesSizesThatMakeNoSense) {
  EXPECT_THROW(contact_sheet({}, 0, 100, ""), std::invalid_argument);
  EXPECT_THROW(contact_sheet({}, 2, 0, ""), std::invalid_argument);
  EXPECT_THROW(contact_sheet({{Image(1, 1000, kBlue), ""}}, 1, 100000, ""), RenderError);
  EXPECT_THROW(contact_sheet({}, 2, 2000000000, ""), RenderError);
}

}  // namespace
}  // namespace clca::render
