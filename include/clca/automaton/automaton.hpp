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

/// What one step did.
struct StepReport {
  std::size_t looked_at = 0;  ///< particles that were awake
  std::size_t moved = 0;
  std::size_t emitted = 0;
  std::size_t removed = 0;
  std::size_t walls_moved = 0;
  std::size_t walls_stalled = 0;  ///< wanted to move and could not
  /// Nothing moved, nothing entered, no open source has anything to give that finds room, and no
  /// wall wants to move or those that do cannot: no later step can change anything.
  bool settled = false;
};

struct Options {
  /// Threads to use, at least 1; the result does not depend on it. That they can be started is for
  /// the caller to find out (parallel::start_team): OpenMP ends the program where they cannot.
  int threads = 1;
  /// Steps with fewer awake particles run on one thread.
  std::size_t parallel_from = 4096;
  /// Look at every particle in every step, also at those that cannot move. For checks only.
  bool sleeping = true;
  /// Takes up what the phases of each step cost; outlives the automaton. Measuring costs a little
  /// itself.
  Profile* profile = nullptr;
};

/// Runs a State. Copies of the state it hands out are independent of it. When a change throws other
/// than std::invalid_argument or std::out_of_range (std::bad_alloc), it is half done: all that
/// would change the state after that throws std::logic_error.
class Automaton {
 public:
  /// Throws std::invalid_argument when the state is not valid (see grains::check_valid,
  /// grains::Occupancy), the rules are not (check_rules), or the number of threads is not positive.
  explicit Automaton(grains::State state, Rules rules = {}, Options options = {});
  ~Automaton();
  Automaton(const Automaton&) = delete;
  Automaton& operator=(const Automaton&) = delete;
  Automaton(Automaton&&) noexcept;
  Automaton& operator=(Automaton&&) noexcept;

  const grains::State& state() const;
  const Rules& rules() const;
  const grains::Occupancy& occupancy() const;

  /// One step: moving walls, sources, provisional directions, moves in order of priority, outlets.
  StepReport step();

  /// Places `counts` (per species) particles at random in `region`, see grains::fill_region.
  /// Throws std::invalid_argument unless there is one count for each species, and for a region that
  /// is not a number.
  grains::FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  /// Sets `counts` (per species) particles down in `region`, each where it comes to rest on those
  /// before it, see grains::deposit_in: a packing that is settled as it is. Throws as fill, and
  /// unless gravity points down.
  grains::FillResult deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts);
  // Walls and sources by index; of one that is not there these throw std::out_of_range.

  /// Takes a wall away; nothing happens when it is gone already.
  void remove_wall(std::size_t wall);
  /// Puts a wall where it is not yet. Returns false and changes nothing when a particle stands in
  /// its way, or another wall and one of the two moves.
  bool insert_wall(std::size_t wall);
  /// Sets a wall in motion or holds it. Throws std::invalid_argument when it has no motion.
  void set_motion(std::size_t wall, bool active);
  /// Opens or closes a source.
  void set_source(std::size_t source, bool open);
  /// Sets the origins of all particles to where they are now.
  void mark_origins();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::automaton
