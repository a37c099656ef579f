// What the contact model refuses to work with, and what it tells of a state.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "clca/contact/contact_model.hpp"
#include "support/states.hpp"

namespace clca::contact::contact_state_test {
namespace {

using testing::empty_state;
using testing::particle_at;

/// Two hexagons, a wall, a source; something in every list.
State good_state() {
  State state{.grains = empty_state(40, 40)};
  state.grains.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  state.grains.particles = {particle_at(10, 1), particle_at(10, 5, 1)};
  state.grains.origins = {{10, 1}, {10, 5}};
  state.grains.walls = {{.sites = {{30, 30}}}};
  state.grains.sources = {{.sites = {{20, 30}}, .weights = {1, 1}}};
  state.velocities.resize(2);
  state.remainders.resize(2);
  state.contacts = {{.upper = 1, .other = 0}, {.upper = 0, .other = kFloor}};
  return state;
}

constexpr Parameters kParameters = {.fall_height = 20};

std::string refusal(const State& state, const Parameters& parameters = kParameters,
                    const Options& options = {}) {
  try {
    const ContactModel model(state, parameters, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// Of a good state with one thing wrong.
std::string refusal_of(const std::function<void(State&)>& spoil) {
  State state = good_state();
  spoil(state);
  return refusal(state);
}

TEST(TheContactModel, TakesAStateWithWallsSourcesAndContacts) {
  EXPECT_EQ(refusal(good_state()), "");
  EXPECT_EQ(refusal(good_state(), kParameters, {.use_reference = true}), "");
  EXPECT_EQ(refusal_of([](State& state) {
              state.contacts = {{.upper = 0, .other = kRightSide},
                                {.upper = 1, .other = grains::wall_code(0)}};
            }),
            "")
      << "a contact that is over";
}

TEST(TheContactModel, RefusesGrainsThatAreNotValidOrOverlap) {
  EXPECT_EQ(refusal_of([](State& state) { state.grains.particles[0].kind = 2; }),
            "a particle is of no kind");
  EXPECT_NE(refusal_of([](State& state) { state.grains.particles[0].row = 2; }), "");
}

TEST(TheContactModel, NeedsOneMotionForEachGrain) {
  const char* reason = "there is not one velocity for each grain";
  EXPECT_EQ(refusal_of([](State& state) { state.velocities.pop_back(); }), reason);
  EXPECT_EQ(refusal_of([](State& state) { state.remainders.emplace_back(); }), reason);
}

TEST(TheContactModel, RefusesNumbersOutOfRange) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  const char* velocity = "a velocity is out of range";
  EXPECT_EQ(refusal_of([](State& state) { state.velocities[1].x = kMaxVelocity; }), "");
  EXPECT_EQ(refusal_of([](State& state) { state.velocities[1].x = kMaxVelocity + 1; }), velocity);
  EXPECT_EQ(refusal_of([](State& state) { state.velocities[0].y = kLeast; }), velocity);
  EXPECT_EQ(refusal_of([](State& state) { state.velocities[0].spin = -kMaxVelocity - 1; }),
            velocity);
  const char* remainder = "a remainder is out of range";
  EXPECT_EQ(refusal_of([](State& state) { state.remainders[0].x = kMaxRemainder + 1; }), remainder);
  EXPECT_EQ(refusal_of([](State& state) { state.remainders[0].y = kLeast; }), remainder);
  const char* impulse = "an impulse is out of range";
  EXPECT_EQ(refusal_of([](State& state) { state.contacts[0].impulse.normal = kMaxImpulse; }), "");
  EXPECT_EQ(refusal_of([](State& state) { state.contacts[0].impulse.normal = -1; }), impulse);
  EXPECT_EQ(refusal_of([](State& state) { state.contacts[0].impulse.normal = kMaxImpulse + 1; }),
            impulse);
  EXPECT_EQ(refusal_of([](State& state) { state.contacts[0].impulse.shear = kLeast; }), impulse);
  EXPECT_EQ(refusal_of([](State& state) { state.contacts[0].impulse.rolling = kMaxImpulse + 1; }),
            impulse);
  EXPECT_EQ(refusal_of([](State& state) {
              state.contacts[0].transient.normal = -state.contacts[0].impulse.normal - 1;
            }),
            impulse);
}

TEST(TheContactModel, RefusesContactsOfWhatIsNotThere) {
  const auto of_contact = [](std::uint32_t upper, grains::Owner other) {
    return refusal_of([&](State& state) { state.contacts = {{.upper = upper, .other = other}}; });
  };
  const char* reason = "a contact is not one of two bodies";
  EXPECT_EQ(of_contact(2, 0), reason);
  EXPECT_EQ(of_contact(0, 2), reason);
  EXPECT_EQ(of_contact(1, 1), reason);
  EXPECT_EQ(of_contact(1, grains::kFree), reason);
  EXPECT_EQ(of_contact(1, grains::wall_code(1)), reason);
  EXPECT_EQ(of_contact(1, kRightSide + 1), reason);
  EXPECT_EQ(of_contact(1, grains::wall_code(0)), "");
  EXPECT_EQ(of_contact(1, kRightSide), "");
}

TEST(TheContactModel, RefusesTwoContactsOfTheSameTwo) {
  EXPECT_EQ(refusal_of([](State& state) { state.contacts.push_back({.upper = 0, .other = 1}); }),
            "two bodies have two contacts");
  EXPECT_EQ(refusal_of([](State& state) { state.contacts.push_back(state.contacts[1]); }),
            "two bodies have two contacts");
}

TEST(TheContactModel, RefusesParametersOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const char* reason = "a parameter of the contact model is out of range";
  const auto with = [](const std::function<void(Parameters&)>& change) {
    Parameters parameters = kParameters;
    change(parameters);
    return refusal(good_state(), parameters);
  };
  EXPECT_EQ(with([](Parameters& all) { all.friction = 16384; }), "");
  EXPECT_EQ(with([](Parameters& all) { all.friction = 16385; }), reason);
  EXPECT_EQ(with([](Parameters& all) { all.friction = -0.1; }), reason);
  EXPECT_EQ(with([nan](Parameters& all) { all.wall_friction = nan; }), reason);
  EXPECT_EQ(with([](Parameters& all) { all.rolling_friction = -1; }), reason);
  EXPECT_EQ(with([](Parameters& all) { all.restitution = 1; }), reason);
  EXPECT_EQ(with([](Parameters& all) { all.sweeps = 0; }), reason);
  for (const auto& change : std::vector<std::function<void(Parameters&)>>{
           [](Parameters& all) { all.fall_height = -1; },
           [](Parameters& all) { all.resolution = -all.resolution; }}) {
    EXPECT_EQ(with(change), "resolution and fall height do not give a time step");
  }
  EXPECT_EQ(with([&](Parameters& all) { all.friction_by_wall = {nan}; }), reason);
  EXPECT_EQ(with([&](Parameters& all) { all.friction_by_wall = {-1.0}; }), reason);
  EXPECT_EQ(with([&](Parameters& all) {
              all.friction_by_wall = {0.1, 0.2};
            }),
            "there are more frictions than walls");
  EXPECT_EQ(with([&](Parameters& all) { all.friction_by_wall = {std::nullopt}; }), "");
}

TEST(TheContactModel, RefusesPeriodicBoxesInWhichTwoGrainsMayTouchOnBothSides) {
  const auto in_columns = [](int columns, bool periodic = true) {
    return refusal_of([=](State& state) {
      state.grains.lattice = lattice::Lattice(columns, 40, periodic);
      state.grains.walls.clear();
      state.grains.particles[0].column = state.grains.particles[1].column = 4;
    });
  };
  EXPECT_EQ(in_columns(10),
            "two grains may touch on both sides in a periodic box of 10 columns: it needs 12");
  EXPECT_EQ(in_columns(12), "");
  EXPECT_EQ(in_columns(10, false), "");
}

TEST(NeededColumns, AreMoreThanTwiceThoseFromAGrainToOneThatItTouches) {
  const auto needed = [](const std::vector<lattice::Shape>& shapes) {
    std::vector<grains::Kind> kinds;
    for (const lattice::Shape& shape : shapes) {
      kinds.push_back({shape});
    }
    return min_periodic_columns(kinds);
  };
  EXPECT_EQ(needed({lattice::Shape::hexagon(0)}), 4);
  EXPECT_EQ(needed({lattice::Shape::hexagon(1)}), 8);
  EXPECT_EQ(needed({lattice::Shape::hexagon(1), lattice::Shape::hexagon(5)}), 24);
  EXPECT_EQ(needed({lattice::Shape::rod(0, 7)}), 4);
  // One ends where the other begins: from -4 to 4 and back are 2 * 9 columns.
  EXPECT_EQ(needed({lattice::Shape({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}),
                    lattice::Shape({{0, 0}, {-1, 0}, {-2, 0}, {-3, 0}, {-4, 0}})}),
            20);
}

TEST(OnlyHexagonsAndDiscs, Turn) {
  State state = good_state();
  state.grains.kinds[1].shape = lattice::Shape::rod(0, 2);
  Parameters parameters = kParameters;
  EXPECT_EQ(refusal(state, parameters), "only hexagons and discs turn: others need Rolling::none");
  parameters.rolling = Rolling::free;
  EXPECT_NE(refusal(state, parameters), "");
  parameters.rolling = Rolling::none;
  EXPECT_EQ(refusal(state, parameters), "");
}

TEST(Gravity, IsThatOfAFallThatEndsWithTheResolutionAsStepsHaveIt) {
  const double value = gravity({.resolution = 0.4, .fall_height = 80});
  EXPECT_NEAR(std::sqrt(2 * value * 80), 0.4, 1e-4);
  EXPECT_EQ(gravity({.resolution = 0.4, .fall_height = 1e4}), 67.0 / kSpacing);
  EXPECT_DOUBLE_EQ(gravity({.resolution = 1, .fall_height = 2}), 0.25);
  EXPECT_THROW(gravity({.resolution = 1, .fall_height = 1.9}), std::invalid_argument);
  EXPECT_THROW(gravity({.resolution = 0.01, .fall_height = 1e6}), std::invalid_argument);
  EXPECT_THROW(gravity({.resolution = 0.4, .fall_height = 0}), std::invalid_argument);
  EXPECT_THROW(gravity({.resolution = 0.4, .fall_height = -5}), std::invalid_argument);
  EXPECT_THROW(gravity({.resolution = std::numeric_limits<double>::quiet_NaN(), .fall_height = 5}),
               std::invalid_argument);
}

TEST(Gravity, OfDefaultParametersIsThatOfAFallFromTheTopOfTheBox) {
  EXPECT_EQ(ContactModel(good_state(), {}).gravity(), gravity({.fall_height = 40.5}));
  EXPECT_EQ(ContactModel({.grains = empty_state(40, 4)}, {}).gravity(),
            gravity({.fall_height = 10}));
}

TEST(Energy, IsThatOfDiscsAtTheirHeights) {
  State state = good_state();
  constexpr double kGravity = 0.01;
  EXPECT_DOUBLE_EQ(energy(state, kGravity).potential, 7 * 1 + 19 * 5);
  EXPECT_EQ(energy(state, kGravity).kinetic, 0);
  state.velocities[0] = {kSpacing / 2, -kSpacing / 4, 0};
  state.velocities[1].spin = kSpacing / 2;
  state.remainders[1].y = -kSpacing / 4;
  EXPECT_DOUBLE_EQ(energy(state, kGravity).kinetic,
                   (7 * (0.25 + 0.0625) / 2 + 19 * 0.25 / 4) / kGravity);
  EXPECT_DOUBLE_EQ(energy(state, kGravity).potential, 7 * 1 + 19 * 4.75);
  state.grains.particles[1].present = false;
  EXPECT_DOUBLE_EQ(energy(state, kGravity).potential, 7);
}

TEST(TheHash, TellsOfEverythingThatARunChanges) {
  const std::uint64_t before = hash(good_state());
  for (const std::function<void(State&)>& change : std::vector<std::function<void(State&)>>{
           [](State& state) { ++state.grains.step; },
           [](State& state) { ++state.velocities[1].spin; },
           [](State& state) { ++state.remainders[0].x; },
           [](State& state) {
             state.from_anchors.resize(2, {1, 0});
           },
           [](State& state) { std::swap(state.contacts[0], state.contacts[1]); },
           [](State& state) { ++state.contacts[1].impulse.rolling; },
           [](State& state) { ++state.contacts[1].transient.normal; },
           [](State& state) { state.changed = false; }, [](State& state) { ++state.unmoved_steps; },
           [](State& state) { ++state.quiet_steps; }}) {
    State state = good_state();
    change(state);
    EXPECT_NE(hash(state), before);
  }
}

}  // namespace
}  // namespace clca::contact::contact_state_test
