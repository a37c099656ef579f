#pragma once
// A model of grains in a box: what all models of the same grains have in common.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::grains {

class Mechanics;

/// Species in fixed proportions by number, without an end of their own: a region is filled until
/// the next particle drawn has no room, or up to a level. A picture divides the region into parts
/// with proportions of their own; a particle belongs to the part that its reference site lies in.
struct Mixture {
  /// Weights of each part: one for each species, not all zero.
  std::vector<std::vector<std::uint32_t>> part_weights = {};
  /// Pixels that cover the region, from the top: kFirstPart is the first part, and so on; others
  /// stay empty. None: the first part is everywhere.
  std::vector<std::string> picture_rows = {};
  bool deposited = false;  ///< a packing at rest, in place of particles at random
  /// Ends the deposition where the surface reaches this mean height, in lattice spacings.
  std::optional<double> surface_level = {};

  static constexpr char kFirstPart = 'A';
};

/// Bytes for the positions that a fill at random tries: each site in each orientation.
double fill_trial_bytes(double sites, double orientations);

/// How many particles a fill has placed.
struct FillResult {
  std::vector<std::size_t> placed_by_species;
  bool complete = true;  ///< false if some of the counts had no room
};

/// How a model takes its steps.
struct Options {
  /// Number of threads, at least 1; does not affect the result. Only the automaton takes several.
  /// The caller must check that they can be started (parallel::start_team): OpenMP ends the program
  /// otherwise.
  int threads = 1;
  /// Smallest number of particles that is worth several threads; none: as measured for the model.
  std::optional<std::size_t> min_parallel_particles = {};
  /// Steps as the model is defined, on one thread. For checks.
  bool use_reference = false;
  /// Automaton only. False: examines every particle in every step. For checks.
  bool allow_sleeping = true;
};

/// Throws std::invalid_argument unless the number of threads is positive.
void check_valid(const Options& options);

/// Results of one step.
struct StepReport {
  // Numbers of particles.
  std::size_t moved_count = 0;
  std::size_t emitted_count = 0;
  std::size_t removed_count = 0;
  /// No later step can change anything, or of the contact model: no grain has moved for some time.
  /// No open source can emit.
  bool settled = false;
};

/// Runs a State. After std::invalid_argument and std::out_of_range it is as before; after any other
/// exception the state is incomplete, and every further change throws std::logic_error.
class Model {
 public:
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// The state of the grains.
  const State& grains() const;
  const Occupancy& occupancy() const;
  /// The lattice direction nearest to gravity.
  lattice::Direction down() const;

  /// One step: sources, moves of walls and particles as the model has them, outlets.
  StepReport step();

  /// `check` is called now and then while particles are placed. What it throws ends that change.
  void set_interruption(std::function<void()> check);

  // After each of these changes, particles that lie wholly in an outlet are removed.

  /// Places `counts` particles per species in `region`: at random, larger species first, or
  /// deposited, a packing at rest (sequential deposition, Visscher & Bolsterli 1972). A species
  /// that no longer fits is placed in part. Throws std::invalid_argument unless there is one count
  /// per species and the region is made of numbers, and for a deposition if the automaton has a
  /// gravity that does not point down.
  FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts,
                  bool deposited = false);
  /// Fills `region` with a mixture. Throws likewise, and if the mixture is not as described there.
  FillResult fill(const lattice::Rectangle& region, const Mixture& mixture);
  // Walls and sources by index; of one that is not there these throw std::out_of_range.

  /// Removes a wall; no effect if it is already removed.
  void remove_wall(std::size_t wall);
  /// Inserts a wall; no effect if it is there. Returns false and changes nothing if a particle is
  /// in its way, or another wall while one of the two is a moving wall.
  bool insert_wall(std::size_t wall);
  /// Starts or stops the motion of a wall. Throws std::invalid_argument if it has none.
  void set_wall_moving(std::size_t wall, bool active);
  /// Opens or closes a source.
  void set_source_open(std::size_t source, bool open);
  /// Sets the origins of all particles to their present positions.
  void reset_origins();

 protected:
  explicit Model(std::unique_ptr<Mechanics> mechanics);
  ~Model();
  Model(Model&&) noexcept;
  Model& operator=(Model&&) noexcept;

  Mechanics& mechanics() const { return *mechanics_; }
  /// Throws std::logic_error after a change that failed halfway.
  void check_intact() const;

 private:
  template <class Change>
  auto carry_out(Change change);
  template <class Change>
  auto change_between_steps(Change change);
  void check_fill(const lattice::Rectangle& region, bool deposited) const;

  std::unique_ptr<Mechanics> mechanics_;
  bool half_changed_ = false;  // a change has failed halfway
};

}  // namespace clca::grains
