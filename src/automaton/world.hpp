#pragma once
// A state and what is kept in line with it: who stands where, who overlaps, who is awake.

#include <span>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/push_book.hpp"
#include "clca/automaton/rules.hpp"
#include "clca/grains/footprint.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/separation.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Somebody who shares sites with a particle.
struct Overlap {
  grains::Owner owner = 0;
  int sites = 0;

  bool operator==(const Overlap&) const = default;
};

class World {
 public:
  /// Throws std::invalid_argument when the state is not valid (see Occupancy).
  World(grains::State initial, const Rules& given_rules);

  /// Makes room for particles that are new from id `first` on and wakes them.
  void welcome_from(std::size_t first);

  /// The places in memory of the particle's sites.
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
  /// Who would share sites with particle `id` if it stood where `at` says; in order of the sites.
  std::vector<Overlap> overlaps(std::uint32_t id, const grains::Particle& at) const;

  /// Moves a particle, whoever shares its sites, forgets the pushes that have ended and wakes
  /// those concerned. Its `previous` becomes the direction.
  void shift(std::uint32_t id, lattice::Direction direction);
  /// Moves many by one site at once; they may stand in each other's way. Adds them to `carried`.
  void shift_together(std::span<const std::uint32_t> ids, lattice::Direction direction);
  /// Takes a particle away for good.
  void take_away(std::uint32_t id);

  /// Wakes those who may gain a free direction now that the place is free.
  void wake_upstream(std::size_t place);

  grains::State state;
  Rules rules;
  grains::Occupancy occupancy;
  grains::FootprintTable footprints;
  AwakeSet awake;
  PushBook pushes;
  grains::Separation separation;
  /// Something but the particles' own moves has changed since the last step.
  bool changed = true;
  std::vector<std::uint32_t> carried;  ///< particles that walls have taken along in this step

 private:
  void forget_ended(std::uint32_t id, const std::vector<Overlap>& before);
};

/// The particle one step further.
inline grains::Particle moved(grains::Particle particle, lattice::Direction direction) {
  const lattice::Site target = particle.site() + unit(direction);
  particle.column = target.column;
  particle.row = target.row;
  return particle;
}

}  // namespace clca::automaton
