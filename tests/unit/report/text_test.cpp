#include "report/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace clca::report::text_test {
namespace {

std::string base64_of(std::string_view text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(Base64, GivesTheTestVectorsOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\x00"), "//4=");  // a literal ends at its first zero
}

TEST(Escaped, LeavesNothingThatIsMarkup) {
  EXPECT_EQ(escaped("<script>&\"'"), "&lt;script&gt;&amp;&quot;&#39;");
  EXPECT_EQ(escaped("ε = ½\n"), "ε = ½\n");
  EXPECT_EQ(escaped("a\x01"
                    "b\xff"
                    "c\x1b[2J"),
            "a\ufffdb\ufffdc\ufffd[2J");
}

TEST(Numbers, HaveTheDecimalsOfTheirFiniteErrors) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(decimals_for(std::array{1e307}, std::array{kInfinite}), 0);
  EXPECT_EQ(decimals_for(std::array{0.25, 3.0}, std::array{kInfinite, 0.02}), 3);
  EXPECT_EQ(number_html(2.5, kInfinite, 1), "2.5");
}

TEST(Numbers, HaveFourDigitsAndGroups) {
  EXPECT_EQ(brief(0.123456), "0.1235");
  EXPECT_EQ(brief(34.39), "34.39");
  EXPECT_EQ(brief(-2), "−2");
  EXPECT_EQ(brief(0), "0");
  EXPECT_EQ(brief(0.0000225), "2.25 × 10⁻⁵");
  EXPECT_EQ(brief(-9.999e7), "−1.00 × 10⁸");
  EXPECT_EQ(brief(1234), "1234");
  EXPECT_EQ(whole(12345), "12\u202f345");
  EXPECT_EQ(whole(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(brief(std::nan("")), "–");
  EXPECT_EQ(brief(-std::numeric_limits<double>::infinity()), "−∞");
}

TEST(Numbers, OfOneRowShareTheirDecimals) {
  const std::array<double, 3> mixed = {0.5, 34.391, std::nan("")};
  EXPECT_EQ(decimals_for(mixed), 2);
  EXPECT_EQ(with_decimals(0.5, 2), "0.50");
  const std::array<double, 2> all_whole = {3, 400};
  EXPECT_EQ(decimals_for(all_whole), 0);
}

}  // namespace
}  // namespace clca::report::text_test
