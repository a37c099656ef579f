#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clca/sweep/plan.hpp"

namespace clca::sweep::request_test {
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

/// Of the only key.
std::vector<std::string> values(const Variation& variation) {
  std::vector<std::string> values;
  for (const std::vector<std::string>& row : variation.value_rows) {
    values.push_back(row.at(0));
  }
  return values;
}

TEST(Variation, IsAKeyAndItsValues) {
  const Variation variation = parse_variation("rules.inertia=0, 0.9,1");
  EXPECT_THAT(variation.keys, ElementsAre("rules.inertia"));
  EXPECT_THAT(values(variation), ElementsAre("0", "0.9", "1"));
}

TEST(Variation, KeysVaryTogetherInRows) {
  const Variation variation =
      parse_variation("box.width, walls.gate.box=60,[20,0,21,50]; 80, [40,0,41,50]");
  EXPECT_THAT(variation.keys, ElementsAre("box.width", "walls.gate.box"));
  EXPECT_THAT(variation.value_rows,
              ElementsAre(ElementsAre("60", "[20,0,21,50]"), ElementsAre("80", "[40,0,41,50]")));
}

TEST(Variation, OnlySemicolonsOutsideOfQuotesEndARow) {
  EXPECT_THAT(parse_variation(R"(title,rules.inertia=a,0;"x;y",1)").value_rows,
              ElementsAre(ElementsAre("a", "0"), ElementsAre(R"("x;y")", "1")));
}

TEST(Variation, ARangeStandsForItsNumbers) {
  EXPECT_THAT(values(parse_variation("L0=20:80:20")), ElementsAre("20", "40", "60", "80"));
  EXPECT_THAT(values(parse_variation("a=0:0.9:0.3")), ElementsAre("0", "0.3", "0.6", "0.9"));
  EXPECT_THAT(values(parse_variation("a=5:-1:-2.5,7")), ElementsAre("5", "2.5", "0", "7"));
  EXPECT_THAT(values(parse_variation("a=10000000000000:10000000000003:1")),
              ElementsAre("10000000000000", "10000000000001", "10000000000002", "10000000000003"));
  EXPECT_THAT(values(parse_variation("a=-0.2:0.1:0.1")), ElementsAre("-0.2", "-0.1", "0", "0.1"));
  EXPECT_THAT(values(parse_variation("a=1e-7:3e-7:1e-7")),
              ElementsAre("0.0000001", "0.0000002", "0.0000003"));
  EXPECT_THAT(values(parse_variation("a=0:1000:500")), ElementsAre("0", "500", "1000"));
  EXPECT_THAT(values(parse_variation("a=1:2:3:4,1:2,a:1:2")),
              ElementsAre("1:2:3:4", "1:2", "a:1:2"));
}

TEST(Variation, OnlyCommasOutsideOfBracketsAndQuotesStandBetweenValues) {
  EXPECT_THAT(values(parse_variation("walls.right.box=[70,0,71,460],[80,0,81,460]")),
              ElementsAre("[70,0,71,460]", "[80,0,81,460]"));
  EXPECT_THAT(values(parse_variation("s={a: [1, 2], b: 3},{a: 4}")),
              ElementsAre("{a: [1, 2], b: 3}", "{a: 4}"));
  EXPECT_THAT(values(parse_variation(R"(title="a, \"b, c\"",'it''s, so',it's,"\\",x)")),
              ElementsAre(R"("a, \"b, c\"")", "'it''s, so'", "it's", R"("\\")", "x"));
  EXPECT_THAT(values(parse_variation("t=[\"], [\", 1],a=b")), ElementsAre("[\"], [\", 1]", "a=b"));
  EXPECT_THAT(values(parse_variation("t=],1")), ElementsAre("]", "1"));
}

TEST(Variation, WithoutKeyOrWithMissingOrRepeatedValuesItIsRefused) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "expected KEY=V1,V2"},
      {"rules.inertia", "expected KEY=V1,V2"},
      {"=1,2", "expected KEY=V1,V2"},
      {"a=", "a value is missing; write none"},
      {"a=1,,2", "a value is missing"},
      {"a=1,", "a value is missing"},
      {"a=1,2,1", "the value 1 is named twice"},
      {"a=1,0:2:1", "the value 1 is named twice"},
      {"a=0.5,0.50,5e-1", "the value 0.50 is named twice"},
      {"a=0.5,=1/2", "the value =1/2 is named twice"},
      {"a=[1,2],[1, 2.0]", "the value [1, 2.0] is named twice"},
      {"a=0:1:0", "0:1:0: expected FIRST:LAST:STEP with a step from the first towards the last"},
      {"a=0:1:-1", "expected FIRST:LAST:STEP"},
      {"a=0:1:1e-9", "at most 100000 values"},
      {"a=0:nan:1", "expected FIRST:LAST:STEP"},
      {"a,=1,2", "expected KEY=V1,V2"},
      {"a,b=1,2;3", "expected 2 values with commas between, found 3"},
      {"a,b=1,2;3,4,5", "expected 2 values with commas between, found 3,4,5"},
      {"a,b=1,2;", "a value is missing"},
      {"a,b=1,2;1,2", "the value 1,2 is named twice"},
  };
  for (const auto& [text, reason] : cases) {
    const std::string& given = text;  // a lambda cannot capture the binding itself
    EXPECT_THAT([&] { parse_variation(given); },
                ThrowsMessage<scene::SceneError>(
                    AllOf(StartsWith("--vary " + text + ": error: "), HasSubstr(reason))));
  }
}

TEST(Variation, IsShortenedInItsErrors) {
  try {
    parse_variation("a=" + std::string(10'000, 'x') + ",");
    FAIL();
  } catch (const scene::SceneError& error) {
    EXPECT_LT(std::string(error.what()).size(), 300U);
  }
}

}  // namespace
}  // namespace clca::sweep::request_test
