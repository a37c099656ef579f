#include <gtest/gtest.h>

#include "support/states.hpp"

namespace clca::grains::push_test {
namespace {

TEST(FindPush, FindsThePushOfThatPairAndNoOther) {
  State state = testing::empty_state(9, 9);
  state.pushes = {{.pushed = 1, .pusher = wall_code(0)},
                  {.pushed = 1, .pusher = 2},
                  {.pushed = 3, .pusher = 1}};
  for (const Push& push : state.pushes) {
    EXPECT_EQ(find_push(state, push.pushed, push.pusher), &push);
  }
  EXPECT_EQ(find_push(state, 2, 1), nullptr);
  EXPECT_EQ(find_push(state, 1, 0), nullptr);
  EXPECT_EQ(find_push(state, 4, 0), nullptr);
}

}  // namespace
}  // namespace clca::grains::push_test
