#include "clca/tasks/presence.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <system_error>

#include "support/runs.hpp"

namespace clca::tasks::presence_test {
namespace {

TEST(Presence, IsSeenByOthersAsLongAsItLasts) {
  const testing::ScratchFolder folder;
  const Presence leader(folder.path() / "ranks", 0);
  std::optional<Presence> other(std::in_place, folder.path() / "ranks", 2);
  EXPECT_TRUE(leader.has(2));
  EXPECT_TRUE(other->has(0));
  EXPECT_FALSE(leader.has(1));
  other.reset();
  EXPECT_FALSE(leader.has(2));
}

TEST(Presence, EndsWithItsProcessHoweverThatEnds) {
  const testing::ScratchFolder folder;
  const Presence leader(folder.path() / "ranks", 0);
  std::array<int, 2> ends = {};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const Presence mine(folder.path() / "ranks", 1);
    [[maybe_unused]] const auto told = ::write(ends[1], "x", 1);
    ::pause();
  }
  char letter = 0;
  ASSERT_EQ(::read(ends[0], &letter, 1), 1);
  EXPECT_TRUE(leader.has(1));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_FALSE(leader.has(1));
}

TEST(Presence, OnlyTheFirstRankMakesTheFile) {
  const testing::ScratchFolder folder;
  EXPECT_THROW(Presence(folder.path() / "ranks", 1), std::system_error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "ranks"));
  EXPECT_THROW(Presence(folder.path() / "missing" / "ranks", 0), std::system_error);
}

}  // namespace
}  // namespace clca::tasks::presence_test
