#pragma once
// The connected lattice cellular automaton: one step of the priority-ordered update.

#include <cstddef>
#include <memory>
#include <span>

#include "clca/automaton/profile.hpp"
#include "clca/automaton/rules.hpp"
#include "clca/grains/fill.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Results of one step.
struct StepReport {
  std::size_t examined = 0;  ///< particles that were awake; all, by the reference step
  std::size_t moved = 0;
  std::size_t emitted = 0;
  std::size_t removed = 0;
  std::size_t walls_moved = 0;
  std::size_t walls_stalled = 0;  ///< wanted to move and could not
  /// Nothing moved or entered, no open source can emit, and every wall has finished or is blocked:
  /// no later step can change anything.
  bool settled = false;
};

struct Options {
  /// Number of threads, at least 1; does not affect the result. The caller must check that they can
  /// be started (parallel::start_team): OpenMP ends the program otherwise.
  int threads = 1;
  /// Steps with fewer awake particles run on one thread.
  std::size_t parallel_from = 4096;
  /// Examines every particle in every step, even those that cannot move. For checks.
  bool sleeping = true;
  /// Steps as the model is defined, on one thread. For checks.
  bool reference = false;
  /// Accumulates the time of the phases; must outlive the automaton. Measuring has a small cost.
  Profile* profile = nullptr;
};

/// Bytes that steps need besides the state and its occupancy, for a lattice of so many places.
double step_bytes(double places);

/// Runs a State. After an exception other than std::invalid_argument or std::out_of_range the state
/// is incomplete, and every further change throws std::logic_error.
class Automaton {
 public:
  /// Throws std::invalid_argument if the state (see grains::check_valid, grains::Occupancy) or the
  /// rules (see check_rules) are not valid, or the number of threads is not positive.
  explicit Automaton(grains::State state, Rules rules = {}, Options options = {});
  ~Automaton();
  Automaton(const Automaton&) = delete;
  Automaton& operator=(const Automaton&) = delete;
  Automaton(Automaton&&) noexcept;
  Automaton& operator=(Automaton&&) noexcept;

  const grains::State& state() const;
  const Rules& rules() const;
  grains::Occupancy occupancy() const;

  /// One step: moving walls, sources, provisional directions, moves in order of priority, outlets.
  StepReport step();

  /// Places `counts` particles per species at random in `region`, see grains::fill_region. Throws
  /// std::invalid_argument unless there is one count per species and the region is made of numbers.
  grains::FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  /// Deposits `counts` particles per species in `region`, see grains::deposit_in: a packing at
  /// rest. Throws as fill, and unless gravity points down.
  grains::FillResult deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  /// Fills `region` with a mixture; see grains::Mixture. Throws as deposit() where it is deposited.
  grains::FillResult fill(const lattice::Rectangle& region, const grains::Mixture& mixture);
  // Walls and sources by index; of one that is not there these throw std::out_of_range.

  /// Removes a wall; no effect if it is already removed.
  void remove_wall(std::size_t wall);
  /// Inserts a wall. Returns false and changes nothing if a particle is in its way, or another wall
  /// while one of the two is a moving wall.
  bool insert_wall(std::size_t wall);
  /// Starts or stops the motion of a wall. Throws std::invalid_argument if it has none.
  void set_motion(std::size_t wall, bool active);
  /// Opens or closes a source.
  void set_source(std::size_t source, bool open);
  /// Sets the origins of all particles to their present positions.
  void mark_origins();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::automaton
