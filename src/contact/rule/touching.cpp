#include "contact/rule/touching.hpp"

#include <array>
#include <map>

#include "grains/internal/separation.hpp"

namespace clca::contact {

namespace {

using lattice::Axial;

/// Owner of a site; for the border, which side.
grains::Owner body_at(const lattice::Lattice& lattice, const grains::OccupancyTable& occupancy,
                      std::size_t place) {
  const grains::Owner owner = occupancy.owner(place);
  if (owner != grains::kBorder) {
    return owner;
  }
  const lattice::Site site = lattice.site(place);
  if (site.row < 0) {
    return kFloor;
  }
  if (site.row >= lattice.rows()) {
    return kCeiling;
  }
  return site.column < 0 ? kLeftSide : kRightSide;
}

/// Bodies that block a grain, and the blocked directions as bits.
std::map<grains::Owner, unsigned> blocking(const grains::State& state,
                                           const grains::OccupancyTable& occupancy,
                                           const grains::FootprintTable& footprints,
                                           std::uint32_t id) {
  const grains::Particle& grain = state.particles[id];
  const std::size_t place = state.lattice.index(grain.site());
  const int column = state.lattice.wrapped(grain.column);
  std::map<grains::Owner, unsigned> result;
  for (const lattice::Direction direction : lattice::kDirections) {
    for (const lattice::Offset lead : footprints.of(grain).lead[lattice::index_of(direction)]) {
      const grains::Owner owner =
          body_at(state.lattice, occupancy, state.lattice.at(place, column, lead));
      if (owner != grains::kFree) {
        result[owner] |= 1U << lattice::index_of(direction);
      }
    }
  }
  return result;
}

Axial sum(unsigned directions) {
  Axial result;
  for (const lattice::Direction direction : lattice::kDirections) {
    if ((directions >> lattice::index_of(direction) & 1U) != 0) {
      result = result + unit(direction);
    }
  }
  return result;
}

}  // namespace

std::vector<Touch> wall_touches(const grains::State& state, const grains::OccupancyTable& occupancy,
                                const grains::FootprintTable& footprints, std::uint32_t id) {
  std::vector<Touch> result;
  for (const auto& [owner, directions] : blocking(state, occupancy, footprints, id)) {
    if (const Axial blocked = sum(directions); !grains::is_particle(owner) && blocked != Axial()) {
      result.push_back(
          {.contact = {.upper = id, .other = owner, .normal = unit_vector(Axial() - blocked)}});
    }
  }
  return result;
}

std::vector<Touch> touches(const grains::State& state, const grains::OccupancyTable& occupancy,
                           const grains::FootprintTable& footprints, lattice::Direction down,
                           NormalTable& normals) {
  std::vector<Touch> result;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (!grain.present) {
      continue;
    }
    const std::vector<Touch> walls = wall_touches(state, occupancy, footprints, id);
    result.insert(result.end(), walls.begin(), walls.end());
    for (const auto& [owner, directions] : blocking(state, occupancy, footprints, id)) {
      const auto other = static_cast<std::uint32_t>(owner);
      if (grains::is_particle(owner) && is_above(state, down, id, other)) {
        const grains::Particle& below = state.particles[other];
        const Axial apart = grains::nearest_vector(state.lattice, grain.site(), below.site());
        const UnitVector normal = normals.normal(grain.kind, below.kind, apart);
        if (normal != UnitVector()) {
          result.push_back(
              {.contact = {.upper = id, .other = owner, .normal = normal}, .apart = apart});
        }
      }
    }
  }
  return result;
}

}  // namespace clca::contact
