#include "clca/tasks/background.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace clca::tasks::background_test {
namespace {

TEST(BackgroundCall, MakesOneCallAfterAnother) {
  std::vector<int> calls;
  {
    BackgroundCall background;
    for (int call = 0; call < 20; ++call) {
      background.start([&calls, call] { calls.push_back(call); });
    }
  }
  ASSERT_EQ(calls.size(), 20U) << "at its end it waits";
  EXPECT_EQ(calls.back(), 19);
}

TEST(BackgroundCall, WhatACallThrowsIsThrownByTheNextOrAtTheEnd) {
  const auto fail = [] { throw std::runtime_error("full disk"); };
  BackgroundCall background;
  background.start(fail);
  EXPECT_THROW(background.start([] {}), std::runtime_error);
  background.start(fail);
  EXPECT_THROW(background.finish(), std::runtime_error);
  EXPECT_NO_THROW(background.finish());
}

}  // namespace
}  // namespace clca::tasks::background_test
