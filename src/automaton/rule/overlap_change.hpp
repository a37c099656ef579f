#pragma once
// What a move would change in the overlaps of a particle.

#include <algorithm>
#include <span>
#include <vector>

#include "automaton/rule/world.hpp"

namespace clca::automaton {

/// One of those with whom a particle shares sites before a move or after it. No overlap of two
/// particles is deeper than one move.
struct OverlapChange {
  grains::Owner owner = 0;
  int sites_before = 0;
  int sites_after = 0;

  /// What has to shrink: the depth in a particle, the sites shared with a wall.
  int before() const {
    return grains::is_particle(owner) ? std::min(sites_before, 1) : sites_before;
  }
  int after() const { return grains::is_particle(owner) ? std::min(sites_after, 1) : sites_after; }
  bool grows() const { return grains::is_particle(owner) && sites_after > sites_before; }
  bool begins() const { return grains::is_particle(owner) && sites_before == 0; }
};

/// For a move of particle `id` that stays inside the box.
std::vector<OverlapChange> overlap_changes(const World& world, std::uint32_t id,
                                           lattice::Direction direction);

/// The one that concerns `owner`; null where there is none.
const OverlapChange* find(const std::vector<OverlapChange>& changes, grains::Owner owner);

/// Sites that a particle shares with other particles.
int shared_sites(const World& world, std::uint32_t id);

/// Whether the particle would share no site with `owner` after one of these moves.
bool can_leave(const World& world, const grains::Particle& particle, grains::Owner owner,
               std::span<const lattice::Direction> directions);

/// Whether no move leads out of an overlap with another particle after the one to `there`. Out of
/// an overlap that begins the way back does.
bool is_too_deep(const World& world, const grains::Particle& there, const OverlapChange& change);

}  // namespace clca::automaton
