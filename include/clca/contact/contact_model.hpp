#pragma once
// Lattice contact dynamics: grains with velocities, friction and rolling on the lattice of the
// automaton.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clca/contact/parameters.hpp"
#include "clca/contact/profile.hpp"
#include "clca/contact/state.hpp"
#include "clca/grains/fill.hpp"
#include "clca/grains/occupancy.hpp"

namespace clca::contact {

/// What one step did.
struct StepReport {
  std::size_t moved = 0;
  std::size_t emitted = 0;
  std::size_t removed = 0;
  /// Nothing has moved for some time, nothing has more than the velocity that gravity gives in two
  /// steps, no source will give more, and no wall will move.
  bool settled = false;
  /// Nothing moves, and nothing has more than that velocity.
  bool quiet = false;
  /// Kinetic and potential energy that sources brought less what outlets took, as in Energy.
  double energy_gained = 0;
};

struct Options {
  /// Friction by wall; that of the parameters for those that have none here.
  std::vector<std::optional<double>> wall_friction = {};
  /// Steps as the model is defined, not as they are fast. For checks.
  bool reference = false;
  int threads = 1;  ///< change nothing but the speed
  /// Grains that are worth a thread.
  std::size_t split_from = 1024;
  /// Where steps are to add what they took; it has to outlive the model.
  Profile* profile = nullptr;
};

// In lattice spacings per step squared.
inline constexpr double kLeastGravity = 0x1p-20;
inline constexpr double kMostGravity = 0.25;

/// The acceleration by gravity in lattice spacings per step squared, a multiple of 2^-23. Throws
/// std::invalid_argument unless resolution and fall height are positive and give one in these
/// bounds.
double gravity(const Parameters& parameters);

/// Energy in units of a site's mass, gravity and the lattice spacing.
struct Energy {
  double kinetic = 0;
  /// Against gravity as the vessel stands; 0 where all centres of mass are at the height of the
  /// lower left site.
  double potential = 0;
};
Energy energy(const State& state, double gravity);

/// 64 bits over everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

/// Throws std::invalid_argument, with the reason, unless the model can work with the state (see
/// grains::check_valid): one motion for each grain, contacts of grains, walls and sides that are
/// there, no number out of range, no wall that lets overlap, and none elsewhere than its motion has
/// brought it.
void check_valid(const State& state);

/// Runs a State. When a change throws other than
/// std::invalid_argument or std::out_of_range, it is half done: all that would change the state
/// after that throws std::logic_error.
class ContactModel {
 public:
  /// Throws std::invalid_argument when the state is not valid (see check_valid, grains::Occupancy),
  /// or for parameters out of range.
  ContactModel(State state, const Parameters& parameters, const Options& options = {});
  ~ContactModel();
  ContactModel(const ContactModel&) = delete;
  ContactModel& operator=(const ContactModel&) = delete;
  ContactModel(ContactModel&&) noexcept;
  ContactModel& operator=(ContactModel&&) noexcept;

  const State& state() const;
  /// Of the state; cheaper than state(), which also brings the list of contacts up to date.
  const grains::State& grains() const;
  const grains::Occupancy& occupancy() const;
  const Vessel& vessel() const;

  /// One step: sources, contacts, impulses, moves of grains and walls, outlets. What comes from a
  /// source is at rest, within half a spacing from its site to either side.
  StepReport step();

  // As those of automaton::Automaton. What is new is at rest.
  grains::FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  grains::FillResult deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  void remove_wall(std::size_t wall);
  bool insert_wall(std::size_t wall);
  void set_motion(std::size_t wall, bool active);
  void set_source(std::size_t source, bool open);
  /// Throws std::invalid_argument for one that is not valid. Grains at rest stay so in the vessel.
  void set_vessel(const Vessel& vessel);
  void mark_origins();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::contact
