#include "clca/tasks/ranks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "support/thread_ranks.hpp"

namespace clca::tasks::ranks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Start {
  std::string command = "the same";
  std::string failure;
};

/// What begin() throws on each rank; empty where it throws nothing.
std::vector<std::string> begun(const std::vector<Start>& starts) {
  testing::ThreadRanks all(static_cast<int>(starts.size()));
  std::vector<std::string> errors(starts.size());
  std::vector<std::thread> threads;
  for (std::size_t number = 0; number < starts.size(); ++number) {
    threads.emplace_back([&, number] {
      const auto ranks = all.seen_from(static_cast<int>(number));
      try {
        ranks->begin(starts[number].command, starts[number].failure);
      } catch (const StartError& error) {
        errors[number] = error.what();
      }
      EXPECT_TRUE(ranks->has_begun());
      EXPECT_EQ(ranks->is_at_work(), errors[number].empty() && starts[number].failure.empty());
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return errors;
}

TEST(Ranks, BeginTogetherIfAllHaveTheSameCommand) {
  EXPECT_THAT(begun({{}, {}, {}}), ElementsAre("", "", ""));
  EXPECT_THAT(begun({{}}), ElementsAre(""));
}

TEST(Ranks, TheFailureOfOneIsToldToAllOthers) {
  const std::string line = "scene.yaml:1:1: error: no such file";
  const std::string of_two = "rank 2: " + line;
  EXPECT_THAT(begun({{}, {}, {"", line}}), ElementsAre(of_two, of_two, ""));
  EXPECT_THAT(begun({{"", line}, {}, {}}), ElementsAre("", line, line));
  EXPECT_THAT(begun({{"", line}, {"", line}}), ElementsAre("", ""));
}

TEST(Ranks, AnotherCommandIsAFailure) {
  const std::string line =
      "rank 1: error: it was started with another scene, folder or version of clca";
  EXPECT_THAT(begun({{}, {"another", ""}, {}}), ElementsAre(line, line, line));
}

TEST(Ranks, TheOthersWorkUntilTheyAreDismissed) {
  testing::ThreadRanks all(3);
  std::vector<std::size_t> works(3);
  std::vector<std::thread> others;
  for (const int number : {1, 2}) {
    others.emplace_back([&, number] {
      const auto ranks = all.seen_from(number);
      while (const auto work = ranks->wait_for_work()) {
        EXPECT_THAT(*work, ElementsAre(number));
        ++works[static_cast<std::size_t>(number)];
      }
      EXPECT_EQ(ranks->wait_for_work(), std::nullopt);
    });
  }
  const auto first = all.seen_from(0);
  const auto number = [](int rank) { return Bytes{static_cast<std::uint8_t>(rank)}; };
  first->hand_out_work(number);
  EXPECT_EQ(first->next_number(), 0U);
  EXPECT_EQ(first->next_number(), 1U);
  first->hand_out_work(number);
  EXPECT_EQ(first->next_number(), 0U);
  EXPECT_FALSE(first->is_dismissed());
  first->dismiss();
  first->dismiss();
  first->hand_out_work(number);
  EXPECT_TRUE(first->is_dismissed());
  for (std::thread& other : others) {
    other.join();
  }
  EXPECT_THAT(works, ElementsAre(0, 2, 2));
  EXPECT_EQ(all.seen_from(1)->receive(), std::nullopt);
}

}  // namespace
}  // namespace clca::tasks::ranks_test
