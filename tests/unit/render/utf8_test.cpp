#include "render/utf8.hpp"

#include <gtest/gtest.h>

namespace clca::render {
namespace {

TEST(Utf8, ComesBackFromCodePoints) {
  const std::string text = "Å µ ε ² – Größe \xF0\x9F\x8C\x8B \xEF\xBF\xBD.";
  EXPECT_EQ(encode_utf8(decode_utf8(text)), text);
  EXPECT_EQ(decode_utf8("aé€\xF0\x9F\x8C\x8B"), U"aé€\U0001F30B");
}

TEST(Utf8, ReplacesBytesThatAreNone) {
  EXPECT_EQ(decode_utf8("a\xFF"
                        "b"),
            U"a\uFFFDb");
  EXPECT_EQ(decode_utf8("\xC3"), U"\uFFFD");                      // cut off
  EXPECT_EQ(decode_utf8("\xC0\xAF"), U"\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(decode_utf8("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");  // a surrogate
  EXPECT_EQ(decode_utf8("\xE2(\xA1"), U"\uFFFD(\uFFFD");
}

}  // namespace
}  // namespace clca::render
