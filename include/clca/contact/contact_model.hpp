#pragma once
// Lattice contact dynamics: grains with velocities, friction and rolling on the lattice of the
// automaton.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clca/contact/energy.hpp"
#include "clca/contact/parameters.hpp"
#include "clca/contact/profile.hpp"
#include "clca/contact/state.hpp"
#include "clca/grains/fill.hpp"
#include "clca/grains/occupancy.hpp"

namespace clca::contact {

/// Results of one step.
struct StepReport {
  std::size_t moved = 0;
  std::size_t emitted = 0;
  std::size_t removed = 0;
  /// Nothing has moved for some time, all velocities are below what gravity gives in two steps, no
  /// source will emit, and no wall will move.
  bool settled = false;
  /// Nothing moves, and all velocities are below that limit.
  bool quiet = false;
  EnergyExchange exchange = {};
};

struct Options {
  /// Friction per wall; none: Parameters::wall_friction.
  std::vector<std::optional<double>> wall_friction = {};
  /// Uses the reference step instead of the fast engine. For checks.
  bool reference = false;
  int threads = 1;  ///< change nothing but the speed
  /// Fewer grains are not worth a thread.
  std::size_t split_from = 1024;
  /// Accumulates the time of steps; must outlive the model.
  Profile* profile = nullptr;
};

// In lattice spacings per step squared.
inline constexpr double kMinGravity = 0x1p-20;
inline constexpr double kMaxGravity = 0.25;

/// Fall height that stands for 0 in a box of this height: the same, but at least kMinFallHeight.
inline constexpr double kMinFallHeight = 10;  // lattice spacings
double default_fall_height(double box_height);

/// Gravity in lattice spacings per step squared, a multiple of 2^-23. Throws std::invalid_argument
/// unless resolution and fall height are positive and give a value within these bounds.
double gravity(const Parameters& parameters);

/// 64-bit hash of everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

/// Throws std::invalid_argument, with the reason, unless the model can run the state (see
/// grains::check_valid): one motion per grain, contacts of existing bodies, all numbers in range,
/// no wall that may overlap, and every wall where its motion can have moved it.
void check_valid(const State& state);

/// Runs a State. After an exception other than std::invalid_argument or std::out_of_range the state
/// is incomplete, and every further change throws std::logic_error.
class ContactModel {
 public:
  /// Throws std::invalid_argument if the state is not valid (see check_valid, grains::Occupancy) or
  /// a parameter is out of range.
  ContactModel(State state, const Parameters& parameters, const Options& options = {});
  ~ContactModel();
  ContactModel(const ContactModel&) = delete;
  ContactModel& operator=(const ContactModel&) = delete;
  ContactModel(ContactModel&&) noexcept;
  ContactModel& operator=(ContactModel&&) noexcept;

  const State& state() const;
  /// Part of state(); cheaper, as state() also updates the list of contacts.
  const grains::State& grains() const;
  grains::Occupancy occupancy() const;
  const Vessel& vessel() const;
  /// In lattice spacings per step squared.
  double gravity() const;

  /// One step: sources, contacts, impulses, moves of grains and walls, outlets. New grains are at
  /// rest, within half a spacing of their site sideways.
  StepReport step();

  // As in automaton::Automaton. New grains are at rest.
  grains::FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  grains::FillResult deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  grains::FillResult fill(const lattice::Rectangle& region, const grains::Mixture& mixture);
  void remove_wall(std::size_t wall);
  bool insert_wall(std::size_t wall);
  void set_motion(std::size_t wall, bool active);
  void set_source(std::size_t source, bool open);
  /// Throws std::invalid_argument for an invalid vessel. Grains at rest stay at rest relative to
  /// the vessel.
  void set_vessel(const Vessel& vessel);
  void mark_origins();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::contact
