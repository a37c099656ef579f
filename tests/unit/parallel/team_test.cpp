// Threads are asked for before they are needed.

#include "clca/parallel/team.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace clca::parallel::team_test {
namespace {

TEST(StartTeam, GivesAsManyThreadsAsAreWantedWhereTheyCanBeHad) {
  EXPECT_EQ(start_team(1), 1);
  EXPECT_EQ(start_team(3), 3);
  int there = 0;
#pragma omp parallel num_threads(3)
  {
#pragma omp atomic
    ++there;
  }
  EXPECT_EQ(there, 3);
}

TEST(StartTeam, GivesOneThreadInAChildProcess) {
  start_team(3);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);  // in place of waiting for ever
    int there = 0;
#pragma omp parallel num_threads(3) reduction(+ : there)
    there += 1;
    ::_exit(10 * start_team(3) + there);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 11);
  EXPECT_EQ(start_team(3), 3) << "here as before";
}

TEST(StartableThreads, AreAsManyAsAreWantedWhereTheyCanBeHad) {
  EXPECT_EQ(startable_threads(1), 1);
  EXPECT_EQ(startable_threads(5), 5);
}

TEST(StartableThreads, RefuseANumberThatIsNotPositive) {
  EXPECT_THROW(startable_threads(0), std::invalid_argument);
}

TEST(StartTeam, RefusesANumberThatIsNotPositive) {
  EXPECT_THROW(start_team(0), std::invalid_argument);
  EXPECT_THROW(start_team(-1), std::invalid_argument);
}

}  // namespace
}  // namespace clca::parallel::team_test
