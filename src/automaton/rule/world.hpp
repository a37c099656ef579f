#pragma once
// A box, who overlaps in it, and its moving walls (moving_walls.cpp).

#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/box.hpp"

namespace clca::automaton {

/// A wall or particle that shares sites with a particle.
struct Overlap {
  grains::Owner owner = 0;
  int shared_sites = 0;

  bool operator==(const Overlap&) const = default;
};

/// Whether one of the overlaps is with `owner`.
bool has_owner(const std::vector<Overlap>& overlaps, grains::Owner owner);

/// Changes since these lists were cleared. The rule only writes them; the engine finds in them
/// which particles to examine again.
struct Changes {
  /// Sites that became free, if nothing has taken them since.
  std::vector<std::size_t> vacated_sites = {};
  std::vector<std::uint32_t> changed_particles = {};  ///< ids: new, moved, or one overlap less
  /// Whether anything has changed by something else than the particles' own moves, also before.
  bool by_others = true;
};

/// A box in which particles may overlap. State::pushes has one push for each pair that does.
class World {
 public:
  /// The box must outlive the world.
  World(grains::Box& around, const Rules& given_rules);

  /// Takes in particles that were added to the state from id `first` on.
  void include_new(std::size_t first);

  /// Who would share sites with particle `id` if it were where `at` is; in order of the sites.
  std::vector<Overlap> overlaps_at(std::uint32_t id, const grains::Particle& at) const;

  /// Moves a particle, whatever shares its sites, and forgets the pushes that have ended. Its
  /// `previous` becomes the direction.
  void move(std::uint32_t id, lattice::Direction direction);
  /// Moves many by one site at once, whatever is in the way. Adds them to `moved_by_walls`.
  void move_together(std::span<const std::uint32_t> ids, lattice::Direction direction);

  /// True when the particle overlaps with something.
  bool is_overlapping(std::uint32_t id) const { return push_counts_[id] > 0; }
  /// All overlapping particles, ascending.
  std::vector<std::uint32_t> overlapping_particles() const;
  /// The pushes onto a particle.
  std::span<const grains::Push> pushes_onto(std::uint32_t id) const;
  /// Enters a push, or renews the one of the same pair.
  void record_push(const grains::Push& push);
  /// Forgets the push between a particle and `other`, whoever pushed. If `other` is a
  /// particle, `changes` has it.
  void forget_push(std::uint32_t id, grains::Owner other);

  /// Forgets the pushes of and onto a particle that will be removed, notes its sites as vacated.
  void prepare_removal(std::uint32_t id);
  /// Particles or walls changed between steps: forgets the pushes of walls that are gone.
  void reload();

  grains::Box& box;
  grains::State& state;               // of the box
  grains::OccupancyTable& occupancy;  // of the box
  Rules rules;
  std::vector<std::uint32_t> moved_by_walls;  ///< particles that walls have moved in this step
  Changes changes;

 private:
  void change_sites(std::span<const std::uint32_t> ids, lattice::Direction direction);
  void count_push(const grains::Push& push, int change);

  std::vector<std::uint32_t> push_counts_;  // by id: those in which the particle takes part
};

/// Moves every active wall by the step that its motion asks for, if it can, in the order of their
/// numbers. Returns whether any has moved.
bool advance_walls(World& world);

/// True when no wall will move while no particle does: each has come to its end, or has tried in
/// vain and cannot take the step that it wants next either.
bool walls_are_still(World& world);

}  // namespace clca::automaton
