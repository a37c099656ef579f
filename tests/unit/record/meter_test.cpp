#include "record/internal/meter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace clca::record::meter_test {
namespace {

TEST(TimeEstimate, FallsWhileTheShareThatIsDoneStaysTheSame) {
  TimeEstimate estimate;
  EXPECT_FALSE(estimate.seconds_left());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  estimate.update(0.25);
  const double before = estimate.seconds_left().value();
  EXPECT_GT(before, 0.03);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  estimate.update(0.25);
  EXPECT_LT(estimate.seconds_left().value(), before);
}

}  // namespace
}  // namespace clca::record::meter_test
