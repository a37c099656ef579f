#pragma once
// A state and what follows from it: who occupies each site and who overlaps.

#include <cstdint>
#include <span>
#include <vector>

#include "automaton/rule/push_list.hpp"
#include "clca/automaton/rules.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/footprint.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "grains/internal/separation.hpp"

namespace clca::automaton {

/// A wall or particle that shares sites with a particle.
struct Overlap {
  grains::Owner owner = 0;
  int sites = 0;

  bool operator==(const Overlap&) const = default;
};

/// What has changed since these lists were cleared. The rule only writes them; the engine finds in
/// them which particles to examine again.
struct Changes {
  std::vector<std::size_t> vacated;  ///< places that became free, if nothing has taken them since
  std::vector<std::uint32_t> particles;  ///< new ones, moved ones, those that lost an overlap
  bool by_others = true;  ///< by something else than the particles' own moves, also before

  void clear() {
    vacated.clear();
    particles.clear();
    by_others = false;
  }
};

class World {
 public:
  /// Throws std::invalid_argument when the state is not valid (see OccupancyTable).
  World(grains::State initial, const Rules& given_rules);

  /// Takes in particles that were added to the state from id `first` on.
  void include_new(std::size_t first);

  /// The particle's sites, or others seen from its reference site, as places in memory.
  template <class Visit>
  void for_each_place(const grains::Particle& particle, Visit visit) const {
    for_each_place(particle, footprints.of(particle).body, visit);
  }
  template <class Visit>
  void for_each_place(const grains::Particle& particle, const std::vector<lattice::Offset>& offsets,
                      Visit visit) const {
    const std::size_t place = state.lattice.index(particle.site());
    const int column = state.lattice.wrapped(particle.column);
    for (const lattice::Offset offset : offsets) {
      visit(state.lattice.at(place, column, offset));
    }
  }

  /// Whether all lead sites are free.
  bool is_free(const grains::Particle& particle, lattice::Direction direction) const;
  /// Who would share sites with particle `id` if it were where `at` is; in order of the sites.
  std::vector<Overlap> overlaps(std::uint32_t id, const grains::Particle& at) const;

  /// Moves a particle, whatever shares its sites, and forgets the pushes that have ended. Its
  /// `previous` becomes the direction.
  void move(std::uint32_t id, lattice::Direction direction);
  /// Moves many by one site at once; they may be in each other's way. Adds them to `carried`.
  void move_together(std::span<const std::uint32_t> ids, lattice::Direction direction);
  /// Removes a particle for good.
  void remove(std::uint32_t id);

  grains::State state;
  Rules rules;
  grains::OccupancyTable occupancy;
  grains::FootprintTable footprints;
  PushList pushes;
  grains::Separation separation;
  std::vector<std::uint32_t> carried;  ///< particles that walls have moved in this step
  Changes changes;

 private:
  void forget_ended_pushes(std::uint32_t id, const std::vector<Overlap>& before);
  void forget_push(std::uint32_t id, grains::Owner other);
};

/// The particle one step further.
inline grains::Particle moved(grains::Particle particle, lattice::Direction direction) {
  const lattice::Site target = particle.site() + unit(direction);
  particle.column = target.column;
  particle.row = target.row;
  return particle;
}

}  // namespace clca::automaton
