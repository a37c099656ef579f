#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "packed_state.hpp"
#include "render/opengl/context.hpp"

namespace clca::render::environment_test {
namespace {

using ::testing::HasSubstr;

TEST(Environment, AllowsTheDriversThatWork) {
  for (const char* driver : {static_cast<const char*>(nullptr), "", "llvmpipe", "softpipe"}) {
    EXPECT_EQ(environment_problem(driver, nullptr), "");
  }
  EXPECT_EQ(environment_problem(nullptr, "128"), "");
  EXPECT_EQ(environment_problem(nullptr, "256"), "");
}

TEST(Environment, NamesTheValueThatDoesNotWork) {
  EXPECT_THAT(environment_problem("zink", nullptr), HasSubstr("GALLIUM_DRIVER is \"zink\""));
  EXPECT_THAT(environment_problem(nullptr, "512"), HasSubstr("512"));
}

TEST(Environment, IsNotLookedAtForTheLookup) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto draw = [] {
    setenv("GALLIUM_DRIVER", "zink", 1);
    picture(empty_state(4, 4, false), DrawingMethod::lookup, 16, 16, 1);
    std::exit(0);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(0), "");
}

TEST(EnvironmentDeathTest, AnUnknownDriverIsAnErrorAndNoCrash) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto draw = [] {
    setenv("GALLIUM_DRIVER", "zink", 1);
    try {
      picture(empty_state(4, 4, false), DrawingMethod::polygons, 16, 16, 1);
    } catch (const RenderError&) {
      std::exit(3);
    }
    std::exit(0);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace clca::render::environment_test
