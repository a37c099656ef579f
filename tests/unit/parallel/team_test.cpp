// Threads are asked for before they are needed.

#include "clca/parallel/team.hpp"

#include <gtest/gtest.h>
#include <omp.h>

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
