#include "clca/text/message.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace clca::text::message_test {

namespace {

constexpr std::array<std::string_view, 4> kWords = {"width", "height", "periodic", "up_left"};

}  // namespace

TEST(Nearest, FindsAWordWithASlip) {
  EXPECT_EQ(nearest_name("wdith", kWords), "width");
  EXPECT_EQ(nearest_name("hight", kWords), "height");
  EXPECT_EQ(nearest_name("Periodical", kWords), "periodic");
  EXPECT_EQ(nearest_name("upleft", kWords), "up_left");
}

TEST(Nearest, FindsNothingForAWordThatIsNotLikeAny) {
  EXPECT_FALSE(nearest_name("colour", kWords).has_value());
  EXPECT_FALSE(nearest_name("", kWords).has_value());
  EXPECT_FALSE(nearest_name(std::string(100'000, 'w'), kWords).has_value());
}

TEST(ShellWord, MeansThePathItself) {
  EXPECT_EQ(shell_word("renders/wall-removal.2"), "renders/wall-removal.2");
  EXPECT_EQ(shell_word("/a b/it's"), "'/a b/it'\\''s'");
  EXPECT_EQ(shell_word("-f"), "./-f");
  EXPECT_EQ(shell_word(""), "''");
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
  EXPECT_EQ(text::quoted(long_text), "'" + cut + "...'");
}

TEST(Listed, CutsLongLists) {
  const std::vector<std::string_view> many(17, "a");
  EXPECT_EQ(comma_separated(std::span(many).first(2)), "a, a");
  EXPECT_TRUE(comma_separated(many).ends_with("a, ..."));
}

}  // namespace clca::text::message_test
