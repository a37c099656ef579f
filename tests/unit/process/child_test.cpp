#include "clca/process/child.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <numeric>
#include <thread>

#include "support/sanitizers.hpp"

namespace clca::process::child_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

using Work = std::function<void(const Child::Send&)>;

/// Why a child failed that should have sent a byte.
std::string failure(const Work& work, const ChildLimits& limits = {}) {
  Child child(work, limits);
  std::array<std::uint8_t, 1> byte = {};
  try {
    child.receive(byte);
    child.finish();
  } catch (const ChildError& error) {
    return std::string(error.crashed() ? "crash: " : "") + error.what();
  }
  return "";
}

void send_byte(const Child::Send& send) {
  send(Bytes{7});
}

TEST(Child, WhatItSendsIsReceived) {
  Bytes many(1'000'000);
  std::iota(many.begin(), many.end(), std::uint8_t{0});
  Child child([&](const Child::Send& send) { send(many); }, {});
  Bytes first(10);
  Bytes rest(many.size() - first.size());
  child.receive(first);
  child.receive(rest);
  child.finish();
  first.insert(first.end(), rest.begin(), rest.end());
  EXPECT_EQ(first, many);
}

TEST(Child, ItChangesNothingHere) {
  int value = 1;
  EXPECT_EQ(failure([&](const Child::Send& send) {
              value = 2;
              send_byte(send);
            }),
            "");
  EXPECT_EQ(value, 1);
}

TEST(Child, AnExceptionArrivesAsItsText) {
  EXPECT_EQ(failure([](const Child::Send&) { throw std::runtime_error("no such thing"); }),
            "no such thing");
  EXPECT_EQ(failure([](const Child::Send&) { throw std::bad_alloc(); }), "out of memory");
  EXPECT_EQ(failure([](const Child::Send& send) {
              send_byte(send);
              throw std::runtime_error("too late");
            }),
            "too late");
}

TEST(Child, ACrashIsReported) {
  EXPECT_EQ(failure([](const Child::Send&) { std::raise(SIGSEGV); }), "crash: crashed (signal 11)");
  EXPECT_EQ(failure([](const Child::Send&) { std::abort(); }), "crash: crashed (signal 6)");
  EXPECT_EQ(failure([](const Child::Send&) { ::_exit(3); }), "crash: ended early (code 3)");
}

TEST(Child, AnEndlessLoopIsEnded) {
  volatile bool forever = true;
  EXPECT_EQ(failure(
                [&](const Child::Send&) {
                  while (forever) {
                  }
                },
                {.cpu_seconds = 1}),
            "crash: took more than 1 s");
}

TEST(Child, SendingMoreOrLessThanExpectedIsAnError) {
  EXPECT_EQ(failure([](const Child::Send&) {}), "crash: ended early (code 0)");
  EXPECT_EQ(failure([](const Child::Send& send) {
              send_byte(send);
              send_byte(send);
            }),
            "sent more than expected");
}

TEST(Child, WithoutASanitizerItCannotAllocateMoreThanItsLimit) {
  constexpr std::size_t kMuch = std::size_t{1} << 28U;
  const Work work = [](const Child::Send& send) {
    Bytes bytes(kMuch, 1);
    send(std::span(bytes).first(1));
  };
  EXPECT_EQ(failure(work), "");
  if (!testing::kSanitized) {
    EXPECT_EQ(failure(work, {.memory_bytes = kMuch / 2.0}), "out of memory");
  }
}

TEST(Child, SignalsOfATerminalDoNotEndIt) {
  EXPECT_EQ(failure([](const Child::Send& send) {
              for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
                std::raise(signal);
              }
              send_byte(send);
            }),
            "");
}

TEST(Child, FilesOfTheParentAreNotItsOwn) {
  const int file = ::dup(STDERR_FILENO);
  EXPECT_EQ(failure([file](const Child::Send& send) {
              if (::fcntl(file, F_GETFD) >= 0) {
                throw std::runtime_error("still open");
              }
              send_byte(send);
            }),
            "");
  ::close(file);
}

TEST(Child, OneThatIsNoLongerNeededIsEnded) {
  volatile bool forever = true;
  const Child child(
      [&](const Child::Send&) {
        while (forever) {
          ::pause();
        }
      },
      {});
}

TEST(Child, SeveralThreadsMayHaveTheirOwn) {
  std::vector<std::string> failures(4);
  {
    std::vector<std::jthread> threads;
    for (std::string& one : failures) {
      threads.emplace_back([&one] {
        for (int i = 0; i < 20 && one.empty(); ++i) {
          one = failure([](const Child::Send& send) {
            const Bytes bytes(100'000, 1);
            send(std::span(bytes).first(1));
          });
        }
      });
    }
  }
  EXPECT_THAT(failures, ::testing::Each(""));
}

TEST(Child, WhereThereAreNoFilesLeftThatIsSaid) {
  if (testing::kSanitized) {
    GTEST_SKIP() << "a sanitizer needs pipes of its own";
  }
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  rlimit none = before;
  none.rlim_cur = 0;
  ::setrlimit(RLIMIT_NOFILE, &none);
  std::string reason;
  try {
    const Child child(send_byte, {});
  } catch (const ProcessError& error) {
    reason = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(reason, "cannot make a pipe: Too many open files");
}

}  // namespace
}  // namespace clca::process::child_test
