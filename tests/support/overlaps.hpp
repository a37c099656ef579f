#pragma once
// Who shares sites with whom, found from a state alone and as plainly as it can be.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::testing {

/// Sites with columns wrapped into the box; of a particle also those outside.
using Sites = std::set<lattice::Site>;

Sites body(const grains::State& state, const grains::Particle& particle);
/// Where the particle would be after one more move.
Sites body_after(const grains::State& state, const grains::Particle& particle,
                 lattice::Direction direction);
/// Where wall `number` stands in the box if it has come `offset` sites from home.
Sites wall_body(const grains::State& state, std::size_t number, int offset);
/// Where a wall or a particle stands now.
Sites body_of(const grains::State& state, grains::Owner owner);

bool inside(const grains::State& state, const Sites& sites);
int shared(const Sites& one, const Sites& other);

/// Least number of unit moves of `one` after which it shares no site with `other`, counted up to
/// `most`.
int depth(const grains::State& state, const Sites& one, const Sites& other, int most = 3);

/// All who stand on each site that is not free, walls first, then by id.
std::map<lattice::Site, std::set<grains::Owner>> occupants(const grains::State& state);

/// Two who share a site, the smaller code first.
using Pairs = std::set<std::pair<grains::Owner, grains::Owner>>;
Pairs overlapping_pairs(const grains::State& state);

/// What is wrong with the overlaps and pushes of a state; empty when nothing is.
std::string complaint(const grains::State& state);

}  // namespace clca::testing
