#pragma once
// One step of lattice contact dynamics: the definition of the model.

#include <cstdint>
#include <utility>
#include <vector>

#include "clca/contact/energy.hpp"
#include "clca/contact/state.hpp"
#include "contact/rule/cuts.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/rule.hpp"
#include "contact/rule/walls.hpp"
#include "grains/internal/mechanics.hpp"

namespace clca::contact {

/// Whether this step sorts the contacts anew.
inline bool sorts_contacts(const State& state) {
  constexpr std::uint64_t kEvery = 8;
  return state.changed || state.grains.step % kEvery == 0;
}

/// A step but for the moves themselves: new grains, and the energy that is exchanged.
class Steps : public grains::Mechanics {
 public:
  /// Throws std::invalid_argument if the state is not valid (see check_valid, grains::Occupancy) or
  /// a parameter is out of range.
  Steps(State initial, const Parameters& parameters);

  /// Everything of it is true after write_back().
  const State& state() const { return state_; }
  /// In lattice spacings per step squared.
  double gravity() const { return gravity_; }
  /// In the last step.
  const EnergyExchange& exchange() const { return exchange_; }
  /// Throws std::invalid_argument for an invalid vessel.
  void set_vessel(const Vessel& vessel);
  /// Of the last step.
  const Cuts& cuts() const { return cuts_; }
  /// Sets velocities and contacts of the state.
  virtual void write_back() {}
  /// The same without contacts.
  virtual void write_back_velocities() {}
  /// Those with walls and sides, maybe others, too.
  virtual std::vector<Contact> wall_contacts() const = 0;

  grains::Box& box() final { return box_; }
  lattice::Direction down() const final { return contact::down(state_.vessel); }
  void before_sources() final { exchange_ = {}; }
  void added(std::size_t first) override;
  bool advance(grains::StepReport& report) final;
  void removing(std::uint32_t id) override;
  void reloaded() override;
  void motion_set() final { disturb(state_); }

 protected:
  /// Everything else of a step. Returns how many grains moved.
  virtual std::size_t move_grains() = 0;

  State& own_state() { return state_; }
  const Rule& rule() const { return rule_; }
  void set_cuts(Cuts cuts) { cuts_ = std::move(cuts); }

 private:
  State state_;
  grains::Box box_;
  double gravity_;  // lattice spacings per step squared
  Rule rule_;
  EnergyExchange exchange_;
  Cuts cuts_;
};

/// The definition of a step. Engine does the same faster.
class Reference final : public Steps {
 public:
  Reference(State initial, const Parameters& parameters);

  std::vector<std::uint32_t> moved() const override { return moved_; }
  std::vector<Contact> wall_contacts() const override { return state_.contacts; }

 private:
  std::size_t move_grains() override;

  State& state_;
  const Rule& rule_;
  NormalTable normals_;
  std::vector<std::uint32_t> moved_;
};

}  // namespace clca::contact
