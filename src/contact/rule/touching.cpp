#include "contact/rule/touching.hpp"

#include <array>
#include <map>

#include "grains/internal/separation.hpp"

namespace clca::contact {

namespace {

using lattice::Axial;

/// Owner of a site; for the border, which side.
grains::Owner body_at(const grains::Box& box, std::size_t place) {
  const lattice::Lattice& lattice = box.state.lattice;
  const grains::Owner owner = box.occupancy.owner(place);
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
std::map<grains::Owner, unsigned> blocking(const grains::Box& box, std::uint32_t id) {
  const grains::Particle& grain = box.state.particles[id];
  std::map<grains::Owner, unsigned> result;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::size_t d = lattice::index_of(direction);
    box.for_each_index(grain, box.footprints.of(grain).lead[d], [&](std::size_t place) {
      if (const grains::Owner owner = body_at(box, place); owner != grains::kFree) {
        result[owner] |= 1U << d;
      }
    });
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

std::vector<Touch> wall_touches(const grains::Box& box, std::uint32_t id) {
  std::vector<Touch> result;
  for (const auto& [owner, directions] : blocking(box, id)) {
    if (const Axial blocked = sum(directions); !grains::is_particle(owner) && blocked != Axial()) {
      result.push_back(
          {.contact = {.upper = id, .other = owner, .normal = unit_vector(Axial() - blocked)}});
    }
  }
  return result;
}

std::vector<Touch> touches(const grains::Box& box, lattice::Direction down, NormalTable& normals) {
  const grains::State& state = box.state;
  std::vector<Touch> result;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (!grain.present) {
      continue;
    }
    const std::vector<Touch> walls = wall_touches(box, id);
    result.insert(result.end(), walls.begin(), walls.end());
    for (const auto& [owner, directions] : blocking(box, id)) {
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
