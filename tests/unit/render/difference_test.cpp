#include "clca/render/difference.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace clca::render::difference_test {
namespace {

TEST(Compare, FindsNothingBetweenEqualPictures) {
  const Image image(5, 4, {10, 20, 30});
  const Difference difference = difference_of(image, image, 0);
  EXPECT_EQ(difference.differing_pixels, 0U);
  EXPECT_EQ(difference.largest_difference, 0);
  EXPECT_TRUE(difference.differing_box.isEmpty());
}

TEST(Compare, BoundsThePixelsThatDiffer) {
  const Image first(9, 8, {10, 20, 30});
  Image second = first;
  second.at(2, 3).green = 25;
  second.at(6, 5).blue = 130;
  const Difference difference = difference_of(first, second, 0);
  EXPECT_EQ(difference.differing_pixels, 2U);
  EXPECT_EQ(difference.largest_difference, 100);
  EXPECT_EQ(difference.differing_box.min(), Eigen::Vector2i(2, 3));
  EXPECT_EQ(difference.differing_box.max(), Eigen::Vector2i(6, 5));
  EXPECT_NE(difference.picture.at(2, 3), difference.picture.at(0, 0));
}

TEST(Compare, LetsPassWhatIsWithinTheTolerance) {
  const Image first(3, 3, {10, 20, 30});
  Image second = first;
  second.at(1, 1).red = 14;
  EXPECT_EQ(difference_of(first, second, 4).differing_pixels, 0U);
  EXPECT_EQ(difference_of(first, second, 4).largest_difference, 4);
  EXPECT_EQ(difference_of(first, second, 3).differing_pixels, 1U);
}

TEST(Compare, RefusesPicturesOfOtherSizes) {
  EXPECT_THROW(difference_of(Image(2, 3, {}), Image(3, 2, {}), 0), std::invalid_argument);
}

}  // namespace
}  // namespace clca::render::difference_test
