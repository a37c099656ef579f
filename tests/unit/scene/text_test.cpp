#include "scene/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace clca::scene {

namespace {

constexpr std::array<std::string_view, 4> kWords = {"width", "height", "periodic", "up_left"};

}  // namespace

TEST(Nearest, FindsAWordWithASlip) {
  EXPECT_EQ(nearest("wdith", kWords), "width");
  EXPECT_EQ(nearest("hight", kWords), "height");
  EXPECT_EQ(nearest("Periodical", kWords), "periodic");
  EXPECT_EQ(nearest("upleft", kWords), "up_left");
}

TEST(Nearest, FindsNothingForAWordThatIsNotLikeAny) {
  EXPECT_FALSE(nearest("colour", kWords).has_value());
  EXPECT_FALSE(nearest("", kWords).has_value());
  EXPECT_FALSE(nearest(std::string(100'000, 'w'), kWords).has_value());
}

TEST(Printable, EscapesWhatDoesNotPrint) {
  EXPECT_EQ(printable("a\nb\x1b\xff"
                      "ö"),
            "a\\nb\\x1b\\xffö");
  EXPECT_EQ(printable("\xE2\x80\xA8"), "\\x2028");
}

TEST(Shown, CutsLongTextBetweenCharacters) {
  std::string long_text;
  std::string cut;
  for (int i = 0; i < 50; ++i) {
    long_text += "ö";
    cut += i < 40 ? "ö" : "";
  }
  EXPECT_EQ(shown(long_text), "'" + cut + "...'");
}

TEST(Listed, CutsLongLists) {
  const std::vector<std::string_view> many(17, "a");
  EXPECT_EQ(listed(std::span(many).first(2)), "a, a");
  EXPECT_TRUE(listed(many).ends_with("a, ..."));
}

TEST(CharacterLength, RefusesWhatIsNotUtf8) {
  for (const std::string_view bad : {"\x80", "\xC1\x81", "\xC3", "\xC3x", "\xE0\x80\x80",
                                     "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80"}) {
    EXPECT_EQ(character_length(bad, 0), 0) << printable(bad);
  }
  EXPECT_EQ(character_length("\xF0\x9F\x8F\x94", 0), 4);
}

}  // namespace clca::scene
