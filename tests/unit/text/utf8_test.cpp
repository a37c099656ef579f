#include "clca/text/utf8.hpp"

#include <gtest/gtest.h>

namespace clca::text::utf8_test {
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

TEST(CharacterLength, RefusesWhatIsNotUtf8) {
  for (const std::string_view bad : {"\x80", "\xC1\x81", "\xC3", "\xC3x", "\xE0\x80\x80",
                                     "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80"}) {
    EXPECT_EQ(character_bytes(bad, 0), 0) << bad;
  }
  EXPECT_EQ(character_bytes("\xF0\x9F\x8F\x94", 0), 4);
}

}  // namespace
}  // namespace clca::text::utf8_test
