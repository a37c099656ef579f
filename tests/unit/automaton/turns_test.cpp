#include "automaton/turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clca/random/draw.hpp"

namespace clca::automaton {
namespace {

/// `count` turns; ties are drawn, or few and small, as where directions decide them.
std::vector<Turn> turns(std::uint32_t count, bool drawn) {
  std::vector<Turn> result;
  for (std::uint32_t id = 0; id < count; ++id) {
    const std::uint64_t bits = random::draw(1, 0, id, random::Purpose::tie);
    result.push_back(
        {.key = {.rank = bits % UpdateOrder::kRanks, .tie = drawn ? bits : bits % 3, .id = id}});
  }
  std::reverse(result.begin(), result.end());
  return result;
}

std::vector<UpdateKey> keys(const std::vector<Turn>& turns) {
  std::vector<UpdateKey> result;
  std::transform(turns.begin(), turns.end(), std::back_inserter(result),
                 [](const Turn& turn) { return turn.key; });
  return result;
}

std::vector<UpdateKey> sorted_keys(const std::vector<Turn>& turns) {
  std::vector<UpdateKey> result = keys(turns);
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Turns, AreSortedByTheirKeysHoweverMany) {
  for (const bool drawn : {false, true}) {
    for (const std::uint32_t count : {0U, 1U, 256U, 257U, 10'000U}) {
      std::vector<Turn> some = turns(count, drawn);
      const std::vector<UpdateKey> expected = sorted_keys(some);
      sort(some);
      EXPECT_EQ(keys(some), expected) << count << " turns, drawn: " << drawn;
    }
  }
}

TEST(Turns, StaySortedWhenMerged) {
  std::vector<Turn> all = turns(1000, true);
  std::vector<Turn> more(all.begin() + 300, all.end());
  all.resize(300);
  const std::vector<UpdateKey> expected = sorted_keys(turns(1000, true));
  sort(all);
  sort(more);
  merge(all, more);
  EXPECT_EQ(keys(all), expected);
}

}  // namespace
}  // namespace clca::automaton
