// Changes between steps: those without an effect, those that are refused, and after one that
// failed.

#include "clca/grains/model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>

#include "clca/automaton/automaton.hpp"
#include "clca/baxter/baxter_model.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/voids/void_model.hpp"
#include "grains/internal/mechanics.hpp"
#include "support/states.hpp"

namespace clca::grains::model_test {
namespace {

using testing::empty_state;
using testing::particle_at;

enum Walls : std::size_t { gone, there, blocked };

/// Two grains on the floor, where a wall has been.
State box() {
  State state = empty_state(20, 20);
  state.kinds = baxter::kinds_along_axes(0);
  for (const int column : {0, 18}) {
    state.particles.push_back(particle_at(column, 0));
    state.origins.push_back({column, 0});
  }
  state.walls = {{.sites = {{5, 5}}, .present = false}, {.sites = {{10, 10}}}, {.present = false}};
  for (int column = 0; column < 20; ++column) {
    state.walls[blocked].sites.push_back({column, 0});
  }
  return state;
}

void change_nothing(Model& model) {
  model.remove_wall(gone);
  EXPECT_TRUE(model.insert_wall(there));
  EXPECT_FALSE(model.insert_wall(blocked));
}

template <class AnyModel>
void expect_no_effect(AnyModel model) {
  for (int step = 0; step < 100; ++step) {
    model.step();
  }
  const std::uint64_t before = hash(model.grains());
  change_nothing(model);
  EXPECT_EQ(hash(model.grains()), before);
}

TEST(WallsAsTheyAre, LeaveTheStateOfEveryModelAsItIs) {
  expect_no_effect(automaton::Automaton(box(), {}));
  expect_no_effect(automaton::Automaton(box(), {}, {.use_reference = true}));
  expect_no_effect(voids::VoidModel(box(), {}));
  expect_no_effect(baxter::BaxterModel(box(), {}));
}

TEST(WallsAsTheyAre, LeaveContactsAndRestAsTheyAre) {
  for (const bool reference : {false, true}) {
    contact::State state{.grains = box()};
    state.velocities.resize(2);
    state.remainders.resize(2);
    state.wall_remainders.resize(3);
    contact::ContactModel model(state, {.fall_height = 20}, {.use_reference = reference});
    while (!model.step().settled) {
    }
    const std::uint64_t before = hash(model.state());
    change_nothing(model);
    EXPECT_EQ(hash(model.state()), before);
    EXPECT_TRUE(model.step().settled);
  }
}

/// Fails in its first step.
class Failing final : public Mechanics {
 public:
  Failing() : state_(testing::good_state()), box_(state_) {}
  Box& box() override { return box_; }
  lattice::Direction down() const override { return lattice::Direction::down; }
  bool advance(StepReport& /*report*/) override { throw std::bad_alloc(); }
  std::vector<std::uint32_t> moved_ids() const override { return {}; }

 private:
  State state_;
  Box box_;
};

class FailingModel : public Model {
 public:
  FailingModel() : Model(std::make_unique<Failing>()) {}
};

TEST(AModel, RefusesEveryChangeAfterOneThatFailedHalfway) {
  FailingModel model;
  ASSERT_THROW(model.step(), std::bad_alloc);
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_THROW(model.step(), std::logic_error);
  EXPECT_THROW(model.fill({0, 0, 30, 30}, counts), std::logic_error);
  EXPECT_THROW(model.fill({0, 0, 30, 30}, Mixture{.part_weights = {{1, 1}}}), std::logic_error);
  EXPECT_THROW(model.fill({0, 0, 30, 30}, counts, true), std::logic_error);
  EXPECT_THROW(model.remove_wall(0), std::logic_error);
  EXPECT_THROW(model.insert_wall(0), std::logic_error);
  EXPECT_THROW(model.set_wall_moving(0, true), std::logic_error);
  EXPECT_THROW(model.set_source_open(0, true), std::logic_error);
  EXPECT_THROW(model.reset_origins(), std::logic_error);
}

TEST(AModel, CanBeInterruptedWhileItIsFilled) {
  const std::vector<std::size_t> counts = {200, 200};
  const auto fills = std::to_array<std::function<FillResult(Model&)>>(
      {[&](Model& model) {
         return model.fill({0, 0, 170, 200}, counts);
       },
       [&](Model& model) {
         return model.fill({0, 0, 170, 200}, counts, true);
       },
       [](Model& model) {
         return model.fill({0, 0, 170, 200}, Mixture{.part_weights = {{1, 1}}});
       }});
  for (const auto& fill : fills) {
    State state = empty_state(200, 200);
    state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
    automaton::Automaton model(std::move(state), {});
    model.set_interruption([] { throw std::domain_error("enough"); });
    EXPECT_THROW(fill(model), std::domain_error);
    EXPECT_THROW(fill(model), std::logic_error);
  }
}

}  // namespace
}  // namespace clca::grains::model_test
