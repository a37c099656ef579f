#include "clca/tasks/pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <thread>

#include "support/runs.hpp"
#include "support/thread_ranks.hpp"
#include "tasks/messages.hpp"

namespace clca::tasks::pool_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::chrono::milliseconds kPause(20);
constexpr std::uint64_t kSame = 7;
constexpr std::size_t kTasks = 40;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

Bytes bytes_of_number(std::size_t number) {
  const std::string text = std::to_string(number);
  return {text.begin(), text.end()};
}

std::size_t number_of(const Bytes& bytes) {
  return std::stoul(std::string(bytes.begin(), bytes.end()));
}

/// The square of a number, or kNone where it has been stopped before.
std::size_t square(std::size_t number, const std::atomic<int>& stop) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return stop != 0 ? kNone : number * number;
}

Bytes serve_square(std::size_t /*task*/, const Bytes& request, const std::atomic<int>& stop) {
  return bytes_of_number(square(number_of(request), stop));
}

class PoolTest : public ::testing::Test {
 protected:
  Pool<std::size_t>::Work squares() {
    return {.carry_out = square,
            .request = bytes_of_number,
            .result = [this](std::size_t /*task*/, const Bytes& answer) {
              ++answers_;
              return number_of(answer);
            }};
  }
  void start_rank(int number, std::size_t threads = 1, std::uint64_t fingerprint = kSame,
                  const std::atomic<int>* stop = nullptr) {
    others_.emplace_back([this, number, threads, fingerprint, stop] {
      serve(*all_.seen_from(number), threads, fingerprint, serve_square, stop);
    });
  }
  /// Carries out all tasks and the other ranks to their ends.
  std::map<std::size_t, std::size_t> results(std::size_t threads, bool with_ranks) {
    std::map<std::size_t, std::size_t> found;
    {
      const auto ranks = all_.seen_from(0);
      std::optional<Leader> leader;
      if (with_ranks) {
        leader.emplace(*ranks, folder_.path() / "ranks", kSame, kTasks,
                       [this](const std::string& text) { warnings_.push_back(text); });
      }
      Pool<std::size_t> pool(threads, leader ? &*leader : nullptr, squares(), nullptr);
      for (std::size_t task = 0; task < kTasks; ++task) {
        pool.add(task);
      }
      while (!pool.finished()) {
        for (const auto& [task, result] : pool.take_finished(kPause)) {
          if (result == kNone) {
            pool.put_back(task);
          } else {
            EXPECT_TRUE(found.emplace(task, result).second) << task;
          }
        }
      }
    }
    join();
    return found;
  }
  static void expect_squares(const std::map<std::size_t, std::size_t>& found) {
    EXPECT_THAT(found, SizeIs(kTasks));
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

  testing::ScratchFolder folder_;
  testing::ThreadRanks all_{4};
  std::vector<std::thread> others_;
  std::vector<std::string> warnings_;
  std::size_t answers_ = 0;
};

TEST_F(PoolTest, CarriesOutAllTasksByThreads) {
  expect_squares(results(3, false));
  EXPECT_EQ(answers_, 0U);
}

TEST_F(PoolTest, OtherRanksCarryOutAShareOfThem) {
  start_rank(1);
  start_rank(2, 2);
  start_rank(3);
  expect_squares(results(1, true));
  EXPECT_GT(answers_, kTasks / 4);
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "ranks"));
}

TEST_F(PoolTest, OneThreadTakesThemInTheirOrder) {
  std::vector<std::size_t> order;
  Pool<int> pool(1, nullptr,
                 {.carry_out =
                      [&](std::size_t task, const std::atomic<int>& /*stop*/) {
                        order.push_back(task);
                        return 0;
                      }},
                 nullptr);
  for (const std::size_t task : {3U, 1U, 2U}) {
    pool.add(task);
  }
  pool.put_back(4);
  while (!pool.finished()) {
    pool.take_finished(kPause);
  }
  EXPECT_THAT(order, ElementsAre(4, 3, 1, 2));
}

TEST_F(PoolTest, OneThreadCanBeTheOneThatAsks) {
  const std::thread::id here = std::this_thread::get_id();
  Pool<bool> pool(1, nullptr,
                  {.carry_out =
                       [&](std::size_t /*task*/, const std::atomic<int>& /*stop*/) {
                         return std::this_thread::get_id() == here;
                       }},
                  nullptr, true);
  pool.add(0);
  pool.add(1);
  EXPECT_THAT(pool.take_finished(kPause), SizeIs(1));
  const auto second = pool.take_finished(kPause);
  ASSERT_THAT(second, SizeIs(1));
  EXPECT_TRUE(second.front().result);
  EXPECT_TRUE(pool.finished());
}

TEST_F(PoolTest, RethrowsWhatATaskThrows) {
  Pool<int> pool(2, nullptr,
                 {.carry_out = [](std::size_t /*task*/, const std::atomic<int>& /*stop*/) -> int {
                   throw std::runtime_error("of a task");
                 }},
                 nullptr);
  pool.add(0);
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
  const auto until_stopped = [&](const std::atomic<int>& told) {
    ++begun;
    while (told == 0) {
      std::this_thread::yield();
    }
  };
  others_.emplace_back([&] {
    serve(
        *all_.seen_from(1), 1, kSame,
        [&](std::size_t /*task*/, const Bytes& /*request*/, const std::atomic<int>& told) {
          until_stopped(told);
          return Bytes();
        },
        nullptr);
  });
  {
    const auto ranks = all_.seen_from(0);
    Leader leader(*ranks, folder_.path() / "ranks", kSame, kTasks, [](const std::string&) {});
    Pool<int> pool(1, &leader,
                   {.carry_out =
                        [&](std::size_t /*task*/, const std::atomic<int>& told) {
                          until_stopped(told);
                          return 0;
                        },
                    .request = bytes_of_number,
                    .result = [](std::size_t /*task*/, const Bytes& /*answer*/) { return 0; }},
                   &stop);
    for (std::size_t task = 0; task < 5; ++task) {
      pool.add(task);
    }
    std::size_t ended = 0;
    while (!pool.finished()) {
      ended += pool.take_finished(kPause).size();
      stop = begun == 2 ? 1 : 0;
    }
    EXPECT_EQ(ended, 2U);
  }
  join();
}

TEST_F(PoolTest, TheTasksOfARankThatEndsAreCarriedOutByOthers) {
  others_.emplace_back([this] {  // takes a task and ends without a word
    const auto ranks = all_.seen_from(1);
    std::optional<Presence> presence;
    while (true) {
      const auto message = ranks->receive();
      if (!message) {
        std::this_thread::yield();
        continue;
      }
      const Content content = content_of(message->bytes);
      if (content.kind == Kind::begin) {
        presence.emplace(content.text(), 1);
        ranks->send(0, bytes_of(Kind::greeting, kSame, "2 1"));
      } else if (content.kind == Kind::request) {
        return;
      }
    }
  });
  start_rank(2);
  expect_squares(results(1, true));
  EXPECT_THAT(warnings_, ElementsAre("rank 1 takes no more tasks: it has ended"));
}

TEST_F(PoolTest, ARankThatIsStoppedGivesItsTaskBack) {
  std::atomic<int> stop = 0;
  start_rank(1, 2, kSame, &stop);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop = 15;
  });
  expect_squares(results(1, true));
  later.join();
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(PoolTest, ARankWithAnotherFingerprintGetsNoTasks) {
  start_rank(1, 1, kSame + 1);
  expect_squares(results(1, true));
  EXPECT_EQ(answers_, 0U);
  EXPECT_THAT(warnings_,
              ElementsAre(HasSubstr("rank 1 takes no more tasks: it was started with another")));
}

TEST_F(PoolTest, WhyARankCannotServeIsToldAndTheOthersGoOn) {
  refuse_to_serve(*all_.seen_from(2), "scene.yaml:1:1: error: no such file");
  start_rank(1);
  expect_squares(results(1, true));
  EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr("rank 2"), HasSubstr("scene.yaml:1:1"))));
}

TEST_F(PoolTest, ARankWhereATaskFailsTakesNoMoreAndTheTaskIsDoneElsewhere) {
  others_.emplace_back([this] {
    serve(
        *all_.seen_from(1), 2, kSame,
        [](std::size_t /*task*/, const Bytes& /*request*/,
           const std::atomic<int>& /*stop*/) -> Bytes { throw std::bad_alloc(); },
        nullptr);
  });
  expect_squares(results(1, true));
  EXPECT_THAT(warnings_, ElementsAre("rank 1 takes no more tasks: out of memory"));
}

TEST_F(PoolTest, ARankThatIsStoppedBeginsNothingMore) {
  std::atomic<int> stop = 0;
  std::atomic<int> begun = 0;
  others_.emplace_back([&] {
    serve(
        *all_.seen_from(1), 8, kSame,
        [&](std::size_t /*task*/, const Bytes& request, const std::atomic<int>& told) {
          stop = ++begun == 8 ? 15 : stop.load();
          while (told == 0) {
            std::this_thread::yield();
          }
          return serve_square(0, request, told);
        },
        &stop);
  });
  expect_squares(results(1, true));
  EXPECT_EQ(begun, 8);
}

TEST_F(PoolTest, WhereLocksAreNotSeenRanksServeAllTheSame) {
  others_.emplace_back([this] {  // as one whose locks another machine does not see
    const auto ranks = all_.seen_from(1);
    for (bool over = false; !over;) {
      const auto message = ranks->receive();
      if (!message) {
        std::this_thread::yield();
        continue;
      }
      const Content content = content_of(message->bytes);
      if (content.kind == Kind::begin) {
        ranks->send(0, bytes_of(Kind::greeting, kSame, "1 0"));
      } else if (content.kind == Kind::request) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ranks->send(0, bytes_of(Kind::answer, content.number,
                                bytes_of_number(content.number * content.number)));
      }
      over = content.kind == Kind::end;
    }
  });
  expect_squares(results(1, true));
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("rank 1 does not see the lock of rank 0")));
}

TEST(Watch, BelievesThatARankHasEndedAtTheSecondLook) {
  Watch of_one_that_is_seen;
  EXPECT_FALSE(of_one_that_is_seen.has_ended(true));
  EXPECT_FALSE(of_one_that_is_seen.has_ended(false));
  EXPECT_FALSE(of_one_that_is_seen.has_ended(true));
  EXPECT_FALSE(of_one_that_is_seen.has_ended(false));
  EXPECT_TRUE(of_one_that_is_seen.has_ended(false));
  Watch of_one_that_never_is;
  EXPECT_FALSE(of_one_that_never_is.has_ended(false));
  EXPECT_FALSE(of_one_that_never_is.has_ended(false));
}

TEST_F(PoolTest, RanksForWhichThereIsNothingToDoAreDismissed) {
  start_rank(1);
  start_rank(2);
  dismiss(*all_.seen_from(0));
  join();
}

TEST_F(PoolTest, OfTheRanksThatAreLeftTheFirstSaysThatTheLeaderIsLost) {
  std::atomic<int> told = 0;
  std::atomic<int> ended = 0;
  for (const int number : {1, 2, 3}) {
    others_.emplace_back([this, number, &told, &ended] {
      try {
        serve(*all_.seen_from(number), 1, kSame, serve_square, nullptr);
      } catch (const LeaderLostError&) {
        ++told;
      }
      ++ended;
    });
  }
  const auto ranks = all_.seen_from(0);
  {
    const Presence leader(folder_.path() / "ranks", 0);
    for (const int number : {1, 2, 3}) {
      ranks->send(number, bytes_of(Kind::begin, 0, (folder_.path() / "ranks").string()));
    }
    for (int greetings = 0; greetings < 3;) {
      greetings += ranks->receive() ? 1 : 0;
      std::this_thread::yield();
    }
  }
  join();
  EXPECT_EQ(ended, 3);
  EXPECT_GE(told, 1);
}

}  // namespace
}  // namespace clca::tasks::pool_test
