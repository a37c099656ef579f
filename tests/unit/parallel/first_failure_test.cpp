// What fails in a parallel region is told behind it.

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

#include "clca/parallel/team.hpp"

namespace clca::parallel::first_failure_test {
namespace {

TEST(FirstFailure, OfOneThreadReachesTheCallerAfterAllHavePassedTheirBarriers) {
  FirstFailure failure;
  int done = 0;
#pragma omp parallel num_threads(4)
  {
    for (int phase = 0; phase < 3; ++phase) {
#pragma omp for schedule(static, 1)
      for (int item = 0; item < 4; ++item) {
        failure.guard([&] {
          if (phase == 1 && item == 2) {
            throw std::bad_alloc();
          }
          if (phase == 2) {
#pragma omp atomic
            ++done;
          }
        });
      }
    }
  }
  EXPECT_TRUE(failure.has_failed());
  EXPECT_EQ(done, 0) << "work after the failure";
  EXPECT_THROW(failure.rethrow(), std::bad_alloc);
}

TEST(FirstFailure, IsTheFirstOfSeveral) {
  FirstFailure failure;
  failure.guard([] { throw std::invalid_argument("first"); });
  failure.guard([] { throw std::bad_alloc(); });
  EXPECT_THROW(failure.rethrow(), std::invalid_argument);
}

TEST(FirstFailure, ThatDidNotComeThrowsNothing) {
  FirstFailure failure;
  bool done = false;
  failure.guard([&] { done = true; });
  EXPECT_TRUE(done);
  EXPECT_FALSE(failure.has_failed());
  EXPECT_NO_THROW(failure.rethrow());
}

}  // namespace
}  // namespace clca::parallel::first_failure_test
