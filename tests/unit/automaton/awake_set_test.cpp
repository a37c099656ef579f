#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "automaton/engine/strips.hpp"

namespace clca::automaton::awake_set_test {
namespace {

std::vector<std::uint32_t> listed(const AwakeSet& set) {
  return {set.ids().begin(), set.ids().end()};
}

TEST(AwakeSet, HasEachIdOnceInTheOrderInWhichTheyCame) {
  AwakeSet set;
  set.resize(100'000);
  for (const std::uint32_t id : {99'999U, 64U, 0U, 4096U, 63U, 4095U, 64U}) {
    set.insert(id);
  }
  const std::vector<std::uint32_t> expected = {99'999, 64, 0, 4096, 63, 4095};
  EXPECT_EQ(listed(set), expected);
  EXPECT_TRUE(set.contains(63));
  EXPECT_FALSE(set.contains(62));
  set.clear();
  EXPECT_TRUE(set.ids().empty());
  EXPECT_FALSE(set.contains(63));
}

}  // namespace
}  // namespace clca::automaton::awake_set_test
