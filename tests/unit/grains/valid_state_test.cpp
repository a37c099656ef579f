// States that no model can work with.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/states.hpp"

namespace clca::grains::valid_state_test {
namespace {

using testing::good_state;

std::string refusal_after(const std::function<void(State&)>& change) {
  State state = good_state();
  change(state);
  try {
    check_valid(state);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void set_motion(State& state, WallMotion motion) {
  state.walls[0].motion = std::move(motion);
}

TEST(AState, IsValidWithWallsAndSources) {
  EXPECT_EQ(refusal_after([](State&) {}), "");
}

TEST(AState, IsNotValidWithAShapeWhoseReferenceSiteIsNotItsOwn) {
  EXPECT_EQ(refusal_after([](State& state) {
              state.kinds[0].shape = lattice::Shape({{50, 0}, {51, 0}});
            }),
            "the reference site of a kind is not one of its sites");
}

TEST(AState, IsNotValidWithParticlesOfNoKindOrMove) {
  EXPECT_EQ(refusal_after([](State& state) { state.particles[0].kind = 2; }),
            "a particle is of no kind");
  EXPECT_EQ(refusal_after([](State& state) { state.particles[0].previous = 7; }),
            "the last move of a particle is out of range");
  EXPECT_EQ(refusal_after([](State& state) {
              state.particles[0] = testing::particle_at(std::numeric_limits<int>::max(), 0);
            }),
            "a particle is too far away");
}

TEST(AState, IsNotValidWithMotionsThatCannotBeCarriedOut) {
  const auto down = lattice::Direction::down;
  for (const WallMotion& motion :
       {WallMotion{down, Drive{.period = 0, .distance = 1}}, WallMotion{down, Drive{1, -1}},
        WallMotion{down, Wave{.amplitude = 1, .period = 0}},
        WallMotion{down, Wave{.amplitude = -1}},
        WallMotion{down, Shake{.amplitude = -1, .wait = 1}}, WallMotion{down, Path{{{0, 1}}}},
        WallMotion{down, Path{{{4, 1}, {4, 2}}}}, WallMotion{down, Path{{{4, 1}, {9, 7}}}},
        WallMotion{down, Path{{{4, -5}}}},
        WallMotion{down, Wave{.form = Waveform::triangle, .amplitude = 2, .period = 7}},
        WallMotion{static_cast<lattice::Direction>(6), Drive{1, 1}}}) {
    EXPECT_EQ(refusal_after([&](State& state) { set_motion(state, motion); }),
              "the motion of a wall cannot be carried out");
  }
  EXPECT_EQ(refusal_after([](State& state) { state.walls[0].travel.offset = 6; }),
            "a wall is where its motion never goes");
}

TEST(AState, IsNotValidWithSourcesThatHaveNothingToDraw) {
  EXPECT_EQ(refusal_after([](State& state) { state.sources[0].sites.clear(); }),
            "a source has no sites");
  EXPECT_EQ(refusal_after([](State& state) { state.sources[0].weights = {1}; }),
            "a source has not one weight for each kind");
  EXPECT_EQ(refusal_after([](State& state) {
              state.sources[0].weights = {0, 0};
            }),
            "all weights of a source are 0");
}

TEST(AState, IsNotValidWithPushesBetweenNobody) {
  const std::string nobody = "a push names a particle, wall or direction that does not exist";
  EXPECT_EQ(refusal_after([](State& state) { state.pushes = {{.pushed = 1, .pusher = 0}}; }),
            nobody);
  EXPECT_EQ(refusal_after([](State& state) { state.pushes = {{.pushed = 0, .pusher = 5}}; }),
            nobody);
  EXPECT_EQ(refusal_after([](State& state) {
              state.pushes = {{.pushed = 0, .pusher = kFirstWall, .source = 9}};
            }),
            nobody);
}

}  // namespace
}  // namespace clca::grains::valid_state_test
