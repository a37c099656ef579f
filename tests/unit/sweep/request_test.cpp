#include "clca/sweep/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clca::sweep {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(Seeds, AreNumbersAndRangesInAscendingOrder) {
  EXPECT_THAT(parse_seeds("3"), ElementsAre(3));
  EXPECT_THAT(parse_seeds("1..4"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(parse_seeds("1,4,9..12"), ElementsAre(1, 4, 9, 10, 11, 12));
  EXPECT_THAT(parse_seeds("7..7"), ElementsAre(7));
  EXPECT_THAT(parse_seeds("18446744073709551614..18446744073709551615"),
              ElementsAre(18446744073709551614U, 18446744073709551615U));
  EXPECT_EQ(parse_seeds("1..100000").size(), kMaxRuns);
}

TEST(Seeds, WhatIsNoListOfSeedsIsRefusedWithTheReason) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "expected whole numbers"},
      {"a", "found 'a'"},
      {"-1", "found '-1'"},
      {"1.5", "found '1.5'"},
      {"1...4", "found '1...4'"},
      {"1..", "found '1..'"},
      {"..4", "found '..4'"},
      {"1..2..3", "found '1..2..3'"},
      {"1,,2", "found ''"},
      {"1,", "found ''"},
      {" 1", "found ' 1'"},
      {"18446744073709551616", "found '18446744073709551616'"},
      {"4..1", "4..1 descends"},
      {"1,1", "1 comes after 1"},
      {"1..4,4", "4 comes after 4"},
      {"5,3", "3 comes after 5"},
      {"0..100000", "more than 100000 runs"},
      {"0..18446744073709551615", "more than 100000 runs"},
      {"1..60000,70000..120000", "more than 100000 runs"},
  };
  for (const auto& [text, reason] : cases) {
    const std::string& given = text;  // a lambda cannot capture the binding itself
    EXPECT_THAT([&] { parse_seeds(given); },
                ThrowsMessage<scene::SceneError>(
                    AllOf(StartsWith("--seeds " + text + ": error: "), HasSubstr(reason))));
  }
}

TEST(Seeds, AreWrittenAsShortAsCanBeAndReadBack) {
  for (const char* text :
       {"3", "1..16", "1,4,9..12", "18446744073709551614..18446744073709551615"}) {
    EXPECT_EQ(to_text(parse_seeds(text)), text);
  }
  EXPECT_EQ(to_text(parse_seeds("1,2,3,5")), "1..3,5");
}

TEST(Variation, IsAKeyAndItsValues) {
  const Variation variation = parse_variation("rules.inertia=0, 0.9,1");
  EXPECT_EQ(variation.key, "rules.inertia");
  EXPECT_THAT(variation.values, ElementsAre("0", "0.9", "1"));
}

TEST(Variation, OnlyCommasOutsideOfBracketsAndQuotesStandBetweenValues) {
  EXPECT_THAT(parse_variation("walls.right.box=[70,0,71,460],[80,0,81,460]").values,
              ElementsAre("[70,0,71,460]", "[80,0,81,460]"));
  EXPECT_THAT(parse_variation("s={a: [1, 2], b: 3},{a: 4}").values,
              ElementsAre("{a: [1, 2], b: 3}", "{a: 4}"));
  EXPECT_THAT(parse_variation(R"(title="a, \"b, c\"",'it''s, so',it's,"\\",x)").values,
              ElementsAre(R"("a, \"b, c\"")", "'it''s, so'", "it's", R"("\\")", "x"));
  EXPECT_THAT(parse_variation("t=[\"], [\", 1],a=b").values, ElementsAre("[\"], [\", 1]", "a=b"));
  EXPECT_THAT(parse_variation("t=],1").values, ElementsAre("]", "1"));
}

TEST(Variation, WithoutKeyOrWithMissingOrRepeatedValuesItIsRefused) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "expected KEY=V1,V2"},
      {"rules.inertia", "expected KEY=V1,V2"},
      {"=1,2", "expected KEY=V1,V2"},
      {"a=", "a value is missing"},
      {"a=1,,2", "a value is missing"},
      {"a=1,", "a value is missing"},
      {"a=1,2,1", "the value 1 is named twice"},
  };
  for (const auto& [text, reason] : cases) {
    const std::string& given = text;  // a lambda cannot capture the binding itself
    EXPECT_THAT([&] { parse_variation(given); },
                ThrowsMessage<scene::SceneError>(
                    AllOf(StartsWith("--vary " + text + ": error: "), HasSubstr(reason))));
  }
}

}  // namespace
}  // namespace clca::sweep
