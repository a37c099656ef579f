#pragma once
// One step of lattice contact dynamics: the definition of the model.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "clca/contact/contact_model.hpp"
#include "clca/contact/state.hpp"
#include "contact/rule/law.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/touching.hpp"
#include "grains/internal/mechanics.hpp"

namespace clca::contact {

/// Ends a step: updates walls and vessel. `rest_speed`: the rest limit; `at_rest`: no grain is
/// faster.
void end_step(State& state, std::span<const WallMove> walls, const SiteMoves& moves,
              std::int32_t rest_speed, bool at_rest);

/// Counts steps at rest from 0 again, since something may move.
void reset_rest_counters(State& state);

/// State::unmoved_steps after which grains count as at rest. `rest_speed`:
/// Rule::rest_speed_limit(). Grains that are faster for so long without going anywhere are held up,
/// though their contacts let them move, or hop about.
std::uint64_t unmoved_steps_at_rest(std::int32_t rest_speed);

/// Whether grains have come to rest.
bool grains_are_at_rest(const State& state, std::int32_t rest_speed);

/// A step but for the moves themselves: new grains, and the energy that is exchanged.
class ContactMechanics : public grains::Mechanics {
 public:
  /// Throws std::invalid_argument if the state is not valid (see check_valid, grains::Occupancy) or
  /// a parameter is out of range.
  ContactMechanics(State initial, const Parameters& parameters);

  /// Its contacts are the present ones only after write_contacts_back().
  const State& state() const { return state_; }
  /// In lattice spacings per step squared.
  double gravity() const { return gravity_; }
  const LastStep& last_step() const { return last_step_; }
  std::uint64_t unmoved_steps_at_rest() const {
    return contact::unmoved_steps_at_rest(rule_.rest_speed_limit());
  }
  /// Throws std::invalid_argument for an invalid vessel.
  void set_vessel(const Vessel& vessel);
  /// Sets the contacts of the state.
  virtual void write_contacts_back() {}
  /// Contacts of the last step with walls and sides, maybe others, too.
  virtual std::vector<Contact> wall_contacts() const = 0;

  grains::Box& box() final { return box_; }
  lattice::Direction down() const final { return contact::down(state_.vessel); }
  void before_sources() final { last_step_ = {}; }
  void on_added(std::size_t first) override;
  bool advance(grains::StepReport& report) final;
  std::vector<std::uint32_t> moved_ids() const final { return moved_; }
  void on_removing(std::uint32_t id) override;
  void on_reloaded() override;
  void on_motion_set() final { reset_rest_counters(state_); }

 protected:
  /// Everything else of a step. Sets moved_.
  virtual void move_grains() = 0;

  // NOLINTBEGIN(readability-identifier-naming): as private ones, beside functions of their names
  State state_;
  grains::Box box_;
  double gravity_;  // lattice spacings per step squared
  Rule rule_;
  LastStep last_step_;
  std::vector<std::uint32_t> moved_;  // ids, in the last step, once each
  // NOLINTEND(readability-identifier-naming)
};

/// The definition of a step. Engine does the same faster.
class ReferenceMechanics final : public ContactMechanics {
 public:
  ReferenceMechanics(State initial, const Parameters& parameters)
      : ContactMechanics(std::move(initial), parameters), normals_(state_.grains.kinds) {}

  std::vector<Contact> wall_contacts() const override { return state_.contacts; }

 private:
  void move_grains() override;

  NormalTable normals_;
};

// Impacts, in impacts.cpp.

/// Most grains of a small group, which contacts connect; walls connect none.
inline constexpr std::size_t kMaxSmallGroup = 8;

/// The contacts of each small group in which one carries or bounces, in their order.
std::vector<std::vector<StepContact*>> active_small_groups(std::span<StepContact> contacts,
                                                           std::size_t grains);

/// Where a contact of a small group bounces, sets `transient` of all of them and changes the
/// velocities. First the bodies are stopped, by sweeps until the impulses hardly change any more;
/// then the same impulses act again, times the restitution (Poisson's hypothesis with one ratio for
/// the whole impact), or less, so that the kinetic energy does not rise. The contacts do not bounce
/// once more. `contacts`: all of their grains.
void solve_impact(std::span<StepContact* const> contacts, const BodyVelocities& bodies);

/// Goes on sweeping a small group until its impulses hardly change any more. What the sweeps of the
/// step have left is added to `transient`: the next step begins with the impulses of these sweeps
/// alone, which stay soft where the group becomes part of a bed.
void converge_group(std::span<StepContact* const> contacts, const BodyVelocities& bodies);

// Energy, in energy.cpp.

/// Energy of a present grain; `gravity` in lattice spacings per step squared.
Energy grain_energy(const State& state, std::size_t id, double gravity);

/// Positions of the walls along their motions, in lattice spacings: a wall that follows its motion
/// is where that is, one that lags by more than a spacing moves by sites.
std::vector<double> wall_positions(const State& state);

/// Work of walls in the step that led to `state`: impulses times displacements. `contacts`: those
/// with walls, others do not count; `before`: wall_positions.
double wall_work(const State& state, std::span<const Contact> contacts,
                 const std::vector<double>& before, double gravity);

/// Work of the vessel in the step that led to `state`; `before`: the vessel as it began.
double vessel_work(const State& state, const Vessel& before, double gravity);

}  // namespace clca::contact
