#include "clca/tasks/pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "support/thread_ranks.hpp"

namespace clca::tasks::pool_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr std::chrono::milliseconds kPause(20);
constexpr std::size_t kTasks = 40;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

Bytes bytes_of_number(std::size_t number) {
  const std::string text = std::to_string(number);
  return {text.begin(), text.end()};
}

std::size_t number_of(std::size_t /*task*/, const Bytes& bytes) {
  return std::stoul(std::string(bytes.begin(), bytes.end()));
}

/// The square of a number, or kNone where it has been stopped before.
std::size_t square(std::size_t number, const std::atomic<int>& stop) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return stop != 0 ? kNone : number * number;
}

Bytes square_as_bytes(std::size_t number, const std::atomic<int>& stop) {
  return bytes_of_number(square(number, stop));
}

std::vector<std::size_t> all_tasks() {
  std::vector<std::size_t> tasks(kTasks);
  std::iota(tasks.begin(), tasks.end(), std::size_t{0});
  return tasks;
}

class PoolTest : public ::testing::Test {
 protected:
  using Serve = std::function<Bytes(std::size_t, const std::atomic<int>&)>;

  /// Another rank, with as many threads and tasks of its own.
  void start_rank(int number, std::size_t threads = 1, std::vector<std::size_t> own = {},
                  const Serve& carry_out = square_as_bytes,
                  const std::atomic<int>* stop = nullptr) {
    others_.emplace_back([this, number, threads, own, carry_out, stop] {
      const auto ranks = all_.seen_from(number);
      while (ranks->wait_for_work(stop)) {
        Pool<Bytes> pool(threads, *ranks, all_tasks(), {.carry_out = carry_out}, stop);
        for (const std::size_t task : own) {
          pool.add(task);
        }
        send_results(pool, *ranks);
      }
    });
  }
  /// Carries out all tasks, with all ranks.
  std::map<std::size_t, std::size_t> results(std::size_t threads, Ranks& ranks) {
    std::map<std::size_t, std::size_t> found;
    ranks.hand_out_work([](int /*rank*/) { return Bytes(); });
    Pool<std::size_t> pool(threads, ranks, all_tasks(), {.carry_out = square, .result = number_of},
                           nullptr);
    while (!pool.finished()) {
      for (const auto& [task, result] : pool.take_finished(kPause)) {
        EXPECT_TRUE(found.emplace(task, result).second) << task;
      }
    }
    shares_ = pool.carried_out();
    all_stopped_ = pool.is_stopped();
    stop_signal_ = ranks.stop_signal();
    return found;
  }
  /// With the other ranks, which end then.
  std::map<std::size_t, std::size_t> results_of_ranks() {
    const auto ranks = all_.seen_from(0);
    auto found = results(1, *ranks);
    ranks->dismiss();
    join();
    return found;
  }
  static void expect_squares(const std::map<std::size_t, std::size_t>& found,
                             std::size_t count = kTasks) {
    EXPECT_THAT(found, SizeIs(count));
    for (const auto& [task, result] : found) {
      EXPECT_EQ(result, task * task);
    }
  }
  void join() {
    for (std::thread& other : others_) {
      other.join();
    }
    others_.clear();
  }

  OneRank alone_;
  testing::ThreadRanks all_{4};
  std::vector<std::thread> others_;
  std::vector<std::size_t> shares_;  // tasks that each rank has carried out
  bool all_stopped_ = false;
  int stop_signal_ = 0;
};

TEST_F(PoolTest, CarriesOutAllTasksByThreads) {
  expect_squares(results(3, alone_));
  EXPECT_THAT(shares_, ElementsAre(kTasks));
}

TEST_F(PoolTest, AnExceptionBeforeTheFirstTaskIsThrownWhereResultsAreTaken) {
  Pool<std::size_t> pool(3, alone_, all_tasks(),
                         {.carry_out = square, .begin = [] { throw std::bad_alloc(); }}, nullptr);
  EXPECT_THROW(pool.take_finished(kPause), std::bad_alloc);
}

TEST_F(PoolTest, EachRankCarriesOutAShareOfThem) {
  start_rank(1);
  start_rank(2, 2);
  start_rank(3);
  expect_squares(results_of_ranks());
  EXPECT_EQ(std::accumulate(shares_.begin(), shares_.end(), std::size_t{0}), kTasks);
  EXPECT_LT(shares_.at(0), kTasks * 3 / 4);
}

TEST_F(PoolTest, TheSameRanksCanShareTasksAgain) {
  for (const int number : {1, 2, 3}) {
    start_rank(number);
  }
  const auto ranks = all_.seen_from(0);
  expect_squares(results(1, *ranks));
  expect_squares(results(1, *ranks));
  ranks->dismiss();
  join();
}

TEST_F(PoolTest, ARankHasTasksOfItsOwn) {
  start_rank(1);
  start_rank(2, 1, {kTasks + 1, kTasks + 2});
  start_rank(3, 2, {kTasks + 3});
  expect_squares(results_of_ranks(), kTasks + 3);
}

TEST_F(PoolTest, OneThreadTakesThemInTheirOrderItsOwnFirst) {
  std::vector<std::size_t> order;
  Pool<int> pool(1, alone_, {3, 1, 2},
                 {.carry_out =
                      [&](std::size_t task, const std::atomic<int>& /*stop*/) {
                        order.push_back(task);
                        return 0;
                      }},
                 nullptr);
  pool.add(5);
  pool.add(4);
  while (!pool.finished()) {
    pool.take_finished(kPause);
  }
  EXPECT_THAT(order, ElementsAre(5, 4, 3, 1, 2));
}

TEST_F(PoolTest, OneThreadCanBeTheOneThatAsks) {
  const std::thread::id here = std::this_thread::get_id();
  Pool<bool> pool(1, alone_, {0, 1},
                  {.carry_out =
                       [&](std::size_t /*task*/, const std::atomic<int>& /*stop*/) {
                         return std::this_thread::get_id() == here;
                       }},
                  nullptr, true);
  EXPECT_THAT(pool.take_finished(kPause), SizeIs(1));
  const auto second = pool.take_finished(kPause);
  ASSERT_THAT(second, SizeIs(1));
  EXPECT_TRUE(second.front().result);
  EXPECT_THAT(pool.take_finished(kPause), SizeIs(0));
  EXPECT_TRUE(pool.finished());
}

TEST_F(PoolTest, RethrowsWhatATaskThrows) {
  Pool<int> pool(2, alone_, {0},
                 {.carry_out = [](std::size_t /*task*/, const std::atomic<int>& /*stop*/) -> int {
                   throw std::runtime_error("of a task");
                 }},
                 nullptr);
  EXPECT_THROW(
      {
        while (!pool.finished()) {
          pool.take_finished(kPause);
        }
      },
      std::runtime_error);
}

TEST_F(PoolTest, AStopEndsTasksUnderWayHereAndElsewhere) {
  std::atomic<int> stop = 0;
  std::atomic<int> begun = 0;
  const auto until_stopped = [&](std::size_t task, const std::atomic<int>& told) {
    ++begun;
    while (told == 0) {
      std::this_thread::yield();
    }
    return task;
  };
  for (const int number : {1, 2, 3}) {
    start_rank(number, 2, {}, [&](std::size_t task, const std::atomic<int>& told) {
      return bytes_of_number(until_stopped(task, told));
    });
  }
  const auto ranks = all_.seen_from(0);
  ranks->hand_out_work([](int /*rank*/) { return Bytes(); });
  Pool<std::size_t> pool(1, *ranks, all_tasks(), {.carry_out = until_stopped, .result = number_of},
                         &stop);
  std::size_t ended = 0;
  while (!pool.finished()) {
    ended += pool.take_finished(kPause).size();
    stop = begun == 7 ? 15 : 0;
  }
  EXPECT_EQ(ended, 7U);
  EXPECT_TRUE(ranks->is_dismissed());
  join();
}

TEST_F(PoolTest, ARankThatIsStoppedBeginsNothingMoreAndStopsAll) {
  std::atomic<int> stop = 0;
  std::atomic<int> begun = 0;
  start_rank(
      1, 2, {kTasks, kTasks + 1},
      [&](std::size_t task, const std::atomic<int>& told) {
        stop = ++begun == 2 ? 15 : 0;
        while (told == 0) {
          std::this_thread::yield();
        }
        return square_as_bytes(task, told);
      },
      &stop);
  start_rank(2);
  start_rank(3);
  const auto found = results_of_ranks();
  EXPECT_EQ(begun, 2);
  EXPECT_TRUE(all_stopped_);
  EXPECT_EQ(stop_signal_, 15);
  EXPECT_GE(std::count_if(found.begin(), found.end(),
                          [](const auto& one) { return one.second == kNone; }),
            2);
}

TEST_F(PoolTest, ARankThatIsStoppedTellsAtOnceWhateverItsTasksTake) {
  std::atomic<int> stop = 0;
  std::atomic<bool> is_told = false;
  start_rank(
      1, 1, {kTasks},
      [&](std::size_t task, const std::atomic<int>& told) {
        stop = 15;
        while (!is_told) {
          std::this_thread::yield();
        }
        return square_as_bytes(task, told);
      },
      &stop);
  start_rank(2);
  start_rank(3);
  const auto ranks = all_.seen_from(0);
  ranks->hand_out_work([](int /*rank*/) { return Bytes(); });
  Pool<std::size_t> pool(1, *ranks, {}, {.carry_out = square, .result = number_of}, nullptr);
  while (!pool.finished()) {
    pool.take_finished(kPause);
    is_told = pool.is_stopped();
  }
  EXPECT_EQ(ranks->stop_signal(), 15);
  join();
}

TEST_F(PoolTest, OnceTheOthersAreDismissedNothingBegins) {
  for (const int number : {1, 2, 3}) {
    start_rank(number);
  }
  const auto ranks = all_.seen_from(0);
  ranks->dismiss();
  expect_squares(results(2, *ranks), 0);
  join();
}

}  // namespace
}  // namespace clca::tasks::pool_test
