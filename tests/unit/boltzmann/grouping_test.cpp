#include "boltzmann/engine/grouping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace clca::boltzmann::grouping_test {
namespace {

constexpr Eigen::Index kBlockSize = Grouping::kBlockSize;

std::vector<Eigen::Index> counting(Eigen::Index count) {
  std::vector<Eigen::Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(Grouping, PutsEachParticleIntoOneGroupAndBackToOnePlace) {
  for (const Eigen::Index particles : {2, 3, 7, 8, 9, 100, 1000, 4097}) {
    for (const Eigen::Index size : {64, 1000}) {
      Grouping grouping(particles, size);
      grouping.shuffle(5, static_cast<std::uint64_t>(particles));
      std::vector<Eigen::Index> all_now;
      std::vector<Eigen::Index> all_then;
      std::vector<Eigen::Index> sources;
      std::vector<Eigen::Index> targets;
      for (Eigen::Index group = 0; group < grouping.group_count(); ++group) {
        grouping.members(group, sources, targets);
        all_now.insert(all_now.end(), sources.begin(), sources.end());
        all_then.insert(all_then.end(), targets.begin(), targets.end());
        EXPECT_GE(sources.size(), 2U);
        std::sort(sources.begin(), sources.end());
        std::sort(targets.begin(), targets.end());
        EXPECT_EQ(sources, targets) << "a group keeps to its own places";
      }
      std::sort(all_now.begin(), all_now.end());
      EXPECT_EQ(all_now, counting(particles)) << particles;
    }
  }
}

TEST(Grouping, BringsAnyTwoBlocksTogetherEquallyOften) {
  constexpr Eigen::Index kParticles = kBlockSize * 40;
  constexpr int kSteps = 20'000;
  Grouping grouping(kParticles, 10 * kBlockSize);  // 4 groups of 10 blocks each
  std::map<std::pair<Eigen::Index, Eigen::Index>, int> together;
  std::vector<Eigen::Index> sources;
  std::vector<Eigen::Index> targets;
  for (int step = 0; step < kSteps; ++step) {
    grouping.shuffle(1, static_cast<std::uint64_t>(step));
    for (Eigen::Index group = 0; group < grouping.group_count(); ++group) {
      grouping.members(group, sources, targets);
      for (std::size_t i = 0; i < sources.size(); i += kBlockSize) {
        for (std::size_t j = 0; j < i; j += kBlockSize) {
          ++together[{std::min(sources[i], sources[j]), std::max(sources[i], sources[j])}];
        }
      }
    }
  }
  EXPECT_EQ(together.size(), 40U * 39U / 2U);
  double mean = 0;
  for (const auto& [pair, count] : together) {
    mean += count / 780.0;
  }
  for (const auto& [pair, count] : together) {
    EXPECT_NEAR(count, mean, 0.1 * mean) << pair.first << " and " << pair.second;
  }
}

TEST(Grouping, MovesParticlesAboutWithinTheirGroup) {
  Grouping grouping(1 << 15, 1 << 13);
  std::vector<Eigen::Index> sources;
  std::vector<Eigen::Index> targets;
  grouping.shuffle(3, 0);
  grouping.members(0, sources, targets);
  std::size_t neighbours = 0;
  for (std::size_t i = 1; i < targets.size(); ++i) {
    neighbours += targets[i] / kBlockSize == targets[i - 1] / kBlockSize ? 1 : 0;
  }
  EXPECT_LT(neighbours, targets.size() / 100);
}

}  // namespace
}  // namespace clca::boltzmann::grouping_test
