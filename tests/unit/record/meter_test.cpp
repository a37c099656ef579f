#include "record/internal/meter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace clca::record::meter_test {
namespace {

TEST(TimeEstimate, FallsWhileTheShareThatIsDoneStaysTheSame) {
  TimeEstimate estimate;
  estimate.update(0);
  EXPECT_FALSE(estimate.seconds_left());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  estimate.update(0.01);
  const double before = estimate.seconds_left().value();
  EXPECT_GT(before, 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  estimate.update(0.01);
  EXPECT_LT(estimate.seconds_left().value(), before);
}

TEST(TimeEstimate, DoesNotCountWhatWasDoneBefore) {
  TimeEstimate estimate;
  estimate.update(0.5);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  estimate.update(0.55);
  EXPECT_GT(estimate.seconds_left().value(), 0.15);
}

TEST(TimeEstimate, IsNoneOnceMoreTimeHasPassedThanExpected) {
  TimeEstimate estimate;
  estimate.update(0);
  estimate.update(0.9);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(estimate.seconds_left());
  estimate.update(1);
  EXPECT_EQ(estimate.seconds_left(), 0);
}

}  // namespace
}  // namespace clca::record::meter_test
