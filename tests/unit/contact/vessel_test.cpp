// A vessel that tilts, turns and is shaken, and grains in it.

#include "clca/contact/vessel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "clca/contact/contact_model.hpp"
#include "contact/rule/moves.hpp"
#include "support/states.hpp"

namespace clca::contact::vessel_test {
namespace {

using lattice::Direction;
using testing::empty_state;
using testing::particle_at;

const Eigen::Vector2d kNowhere = Eigen::Vector2d::Zero();

TEST(AnAngle, IsOfDegreesAndGoesRound) {
  EXPECT_EQ(angle_from_degrees(90), Angle{1} << 62U);
  EXPECT_EQ(angle_from_degrees(-90), Angle{3} << 62U);
  EXPECT_EQ(angle_from_degrees(360), 0U);
  EXPECT_EQ(angle_from_degrees(450), angle_from_degrees(90));
  for (const double size : {-179.5, -30.0, 0.0, 1e-3, 77.7}) {
    EXPECT_NEAR(to_degrees(angle_from_degrees(size)), size, 1e-9);
  }
  EXPECT_THROW(angle_from_degrees(std::nan("")), std::invalid_argument);
}

TEST(Gravity, TurnsAgainstTheVessel) {
  for (int tenths = -1800; tenths < 1800; tenths += 7) {
    const double turned = tenths / 10.0;
    const double radians = turned * std::numbers::pi / 180;
    const Eigen::Vector2d down = gravity_direction({.angle = angle_from_degrees(turned)});
    EXPECT_NEAR(down.x(), -std::sin(radians), 2e-9) << turned;
    EXPECT_NEAR(down.y(), -std::cos(radians), 2e-9) << turned;
  }
}

TEST(Down, IsTheDirectionOfTheLatticeNearestToGravity) {
  const auto of = [](double turned) { return down({.angle = angle_from_degrees(turned)}); };
  EXPECT_EQ(of(0), Direction::down);
  EXPECT_EQ(of(29.9), Direction::down);
  EXPECT_EQ(of(-29.9), Direction::down);
  EXPECT_EQ(of(30.1), Direction::down_left);
  EXPECT_EQ(of(-30.1), Direction::down_right);
  EXPECT_EQ(of(120), Direction::up_left);
  EXPECT_EQ(of(-120), Direction::up_right);
  EXPECT_EQ(of(179), Direction::up);
  EXPECT_EQ(of(-179), Direction::up);
}

TEST(AVessel, TiltsTheShorterWayInWholeStepsAndThenRests) {
  const Vessel start = Vessel{.angle = angle_from_degrees(170)};
  Vessel vessel = with_tilting(start, angle_from_degrees(-160), 4, kNowhere);
  EXPECT_EQ(vessel.turn_steps, 8U);  // 30 degrees
  EXPECT_NEAR(to_degrees(angle_after(vessel, 4)), -175, 1e-9);
  for (int step = 0; step < 8; ++step) {
    EXPECT_TRUE(vessel.is_moving());
    vessel = vessel_after_step(vessel);
  }
  EXPECT_FALSE(vessel.is_moving());
  EXPECT_NEAR(to_degrees(vessel.angle), -160, 1e-9);
  EXPECT_EQ(vessel_after_step(vessel).angle, vessel.angle);
  EXPECT_EQ(angle_after(vessel, 1000), vessel.angle);
  EXPECT_FALSE(with_tilting(vessel, vessel.angle, 1, kNowhere).is_moving());
}

TEST(AVessel, CountsItsTurnsAndItsShakes) {
  for (Vessel vessel :
       {with_rotation({}, -1.0 / 64, kNowhere), with_shaking({}, 1, 1.0 / 64, false)}) {
    for (int step = 0; step < 64 * 3; ++step) {
      EXPECT_EQ(vessel.whole_cycles, static_cast<std::uint64_t>(step / 64));
      vessel = vessel_after_step(vessel);
    }
    EXPECT_EQ(vessel.whole_cycles, 3U);
    EXPECT_TRUE(vessel.is_moving());
    EXPECT_EQ(without_motion(vessel), (Vessel{.angle = vessel.angle}));
  }
}

TEST(AVessel, ThatIsTooFastOrDoesNotMoveIsRefused) {
  EXPECT_THROW(with_rotation({}, 1.0 / 60, kNowhere), std::invalid_argument);
  EXPECT_THROW(with_rotation({}, 0, kNowhere), std::invalid_argument);
  EXPECT_THROW(with_rotation({}, 1e-3, {1e8, 0}), std::invalid_argument);
  EXPECT_THROW(with_tilting({}, angle_from_degrees(9), 0, kNowhere), std::invalid_argument);
  EXPECT_THROW(with_tilting({}, angle_from_degrees(9), 6, kNowhere), std::invalid_argument);
  EXPECT_THROW(with_tilting({}, angle_from_degrees(9), 1e-30, kNowhere), std::invalid_argument);
  EXPECT_THROW(with_shaking({}, 1001, 1e-2, false), std::invalid_argument);
  EXPECT_THROW(with_shaking({}, 1, 0.07, false), std::invalid_argument);
  EXPECT_THROW(with_shaking({}, 1, 0, false), std::invalid_argument);
  EXPECT_THROW(check_valid(Vessel{.turn = angle_from_degrees(6)}), std::invalid_argument);
  EXPECT_THROW(check_valid(Vessel{.strength = -1}), std::invalid_argument);
  EXPECT_THROW(check_valid(Vessel{.phase_step = Angle{1} << 61U}), std::invalid_argument);
  EXPECT_NO_THROW(check_valid(with_rotation({}, -1.0 / 64, kNowhere)));
}

TEST(Shaking, AddsAndTakesGravityAsASine) {
  constexpr std::int32_t kGravity = 1000;
  const auto at = [](Vessel vessel, double cycles) {
    vessel.phase = angle_from_degrees(360 * cycles);
    return acceleration(vessel, kGravity, false).gravity;
  };
  const Vessel upright = with_shaking({}, 1.5, 0.01, false);
  EXPECT_EQ(at(upright, 0), (Vector{0, -1000}));
  EXPECT_EQ(at(upright, 0.25), (Vector{0, 500}));
  EXPECT_EQ(at(upright, 0.75), (Vector{0, -2500}));
  EXPECT_EQ(at(with_shaking({}, 1.5, 0.01, true), 0.25), (Vector{1500, -1000}));
  const Vector tilted_down =
      at(with_shaking(Vessel{.angle = angle_from_degrees(90)}, 1.5, 0.01, false), 0.25);
  EXPECT_EQ(tilted_down, (Vector{500, 0}));
}

constexpr Parameters kParameters = {.rolling = Rolling::none, .fall_height = 40};

/// Both ways to take steps.
class GrainsInAVessel : public ::testing::TestWithParam<bool> {
 protected:
  /// Hexagons of radius 1 in a box.
  static State state(const std::vector<grains::Particle>& particles, int columns, int rows) {
    State state{.grains = empty_state(columns, rows)};
    state.grains.kinds = {{lattice::Shape::hexagon(1), 0}};
    state.grains.particles = particles;
    for (const grains::Particle& particle : particles) {
      state.grains.origins.push_back(particle.site());
    }
    state.velocities.resize(particles.size());
    state.remainders.resize(particles.size());
    return state;
  }
  static ContactModel model(const State& state) {
    return ContactModel(state, kParameters, {.use_reference = GetParam()});
  }
};

TEST_P(GrainsInAVessel, FlyStraightForWhoStandsOutside) {
  const Eigen::Vector2d centre(90, 100);
  constexpr double kTurnsPerStep = -1.0 / 2400;
  constexpr double kRate = kTurnsPerStep * 2 * std::numbers::pi;
  State start = state({particle_at(110, 130)}, 210, 220);
  const Eigen::Vector2d from = grains::centre(start.grains, start.grains.particles[0]) - centre;
  const Eigen::Vector2d thrown(-0.25, 0.1);  // seen from outside
  const Eigen::Vector2d seen = thrown - kRate * Eigen::Vector2d(-from.y(), from.x());
  start.velocities[0] = {static_cast<std::int32_t>(seen.x() * kSpacing),
                         static_cast<std::int32_t>(seen.y() * kSpacing), 0};
  ContactModel one = model(start);
  one.set_vessel(with_rotation({}, kTurnsPerStep, centre));
  const double fall = gravity(kParameters);
  for (int step = 1; step <= 240; ++step) {
    one.step();
    const Eigen::Vector2d outside =
        from + step * thrown - 0.5 * fall * step * (step + 1) * Eigen::Vector2d(0, 1);
    const Eigen::Vector2d inside = Eigen::Rotation2Dd(-kRate * step) * outside;
    const Eigen::Vector2d place = grains::centre(one.grains(), one.grains().particles[0]) - centre;
    ASSERT_LT((place - inside).norm(), 1) << step;
  }
}

TEST_P(GrainsInAVessel, GainInFreeFlightWhatTheVesselWorks) {
  const double fall = gravity(kParameters);
  for (const Vessel& vessel :
       {with_rotation({}, -1.0 / 2400, Eigen::Vector2d(90, 100)),
        with_tilting({}, angle_from_degrees(70), 0.2, kNowhere),
        with_shaking({}, 2, 1.0 / 150, false), with_shaking({}, 2, 1.0 / 150, true)}) {
    State start = state({particle_at(110, 130)}, 210, 220);
    start.velocities[0] = {-kSpacing / 8, kSpacing / 10, 0};
    ContactModel one = model(start);
    one.set_vessel(vessel);
    const double before = energy(one.state(), fall).sum();
    double work = 0;
    double most = 0;
    for (int step = 0; step < 200; ++step) {
      one.step();
      work += one.last_step().exchange.vessel;
      most = std::max(most, std::abs(work));
      ASSERT_NEAR(energy(one.state(), fall).sum(), before + work, 6) << step;
    }
    EXPECT_GT(most, 20);
  }
}

TEST_P(GrainsInAVessel, SlideWhenItIsSteeperThanTheirFriction) {
  // Friction 0.4: 21.8 degrees. Anticlockwise is down to the left.
  for (const double turned : {-26.0, -18.0, 18.0, 26.0}) {
    ContactModel one = model(state({particle_at(50, 1)}, 101, 40));
    one.set_vessel(Vessel{.angle = angle_from_degrees(turned)});
    for (int step = 0; step < 2000; ++step) {
      one.step();
    }
    const int column = one.grains().particles[0].column;
    EXPECT_EQ(column, turned > 20 ? 1 : turned < -20 ? 99 : 50) << turned;
  }
}

TEST_P(GrainsInAVessel, LeaveTheFloorWhenItIsShakenMoreStronglyThanGravity) {
  for (const double gamma : {0.9, 1.5}) {
    ContactModel one = model(state({particle_at(20, 1)}, 40, 60));
    one.set_vessel(with_shaking({}, gamma, 1.0 / 200, false));
    bool moved = false;
    for (int step = 0; step < 400; ++step) {
      const grains::StepReport report = one.step();
      moved = moved || report.moved_count > 0;
      EXPECT_FALSE(report.settled);
    }
    EXPECT_EQ(moved, gamma > 1) << gamma;
    EXPECT_EQ(one.state().vessel.whole_cycles, 2U);
    one.set_vessel(without_motion(one.state().vessel));
    int steps = 0;
    while (!one.step().settled && steps < 5000) {
      ++steps;
    }
    EXPECT_LT(steps, 5000);
  }
}

TEST_P(GrainsInAVessel, LieTheSameWayWhenItStandsOnItsHead) {
  // Two that stand one on the other, on the ceiling.
  ContactModel one = model(state({particle_at(20, 58), particle_at(20, 55)}, 40, 60));
  one.set_vessel(Vessel{.angle = angle_from_degrees(180)});
  one.step();
  const std::vector<Contact>& contacts = one.state().contacts;
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].upper, 1U);
  EXPECT_EQ(contacts[0].other, 0);
  EXPECT_EQ(contacts[0].normal, (UnitVector{0, -(1 << kUnitBits)}));
  EXPECT_EQ(contacts[1].other, kCeiling);
  for (int step = 0; step < 200; ++step) {
    EXPECT_EQ(one.step().moved_count, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, GrainsInAVessel, ::testing::Bool(),
                         [](const auto& engine) { return engine.param ? "Reference" : "Fast"; });

}  // namespace
}  // namespace clca::contact::vessel_test
