#include "clca/automaton/occupancy.hpp"

#include <stdexcept>

namespace clca::automaton {

namespace {

constexpr std::size_t kWordBits = 64;

void take_free(Occupancy& occupancy, std::size_t index, Owner owner) {
  if (occupancy.taken(index)) {
    throw std::invalid_argument("two particles overlap, or a particle overlaps a wall");
  }
  occupancy.take(index, owner);
}

void take_border(Occupancy& occupancy, const lattice::Lattice& lattice) {
  // A periodic lattice wraps, so its border columns are never looked at.
  const int first = lattice.periodic() ? 0 : -1;
  const int last = lattice.periodic() ? lattice.columns() - 1 : lattice.columns();
  for (int column = first; column <= last; ++column) {
    occupancy.take(lattice.index({column, -1}), kBorder);
    occupancy.take(lattice.index({column, lattice.rows()}), kBorder);
  }
  if (!lattice.periodic()) {
    for (int row = 0; row < lattice.rows(); ++row) {
      occupancy.take(lattice.index({-1, row}), kBorder);
      occupancy.take(lattice.index({lattice.columns(), row}), kBorder);
    }
  }
}

/// Such a particle would stand in its own way.
bool meets_itself(const lattice::Lattice& lattice, const lattice::Shape& shape) {
  const int columns = shape.sites().back().x - shape.sites().front().x + 1;
  return lattice.periodic() && columns >= lattice.columns();
}

}  // namespace

Occupancy::Occupancy(const State& state)
    : words_((state.lattice.memory_size() + kWordBits - 1) / kWordBits, 0),
      owners_(state.lattice.memory_size(), kFree) {
  const lattice::Lattice& lattice = state.lattice;
  take_border(*this, lattice);
  for (const Kind& kind : state.kinds) {
    if (meets_itself(lattice, kind.shape)) {
      throw std::invalid_argument("a kind is as wide as the periodic box");
    }
  }
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    for (const lattice::Site site : state.walls[wall].sites) {
      if (!lattice.contains(site)) {
        throw std::invalid_argument("a wall leaves the box");
      }
      if (state.walls[wall].present) {
        take(lattice.index(site), kFirstWall - static_cast<Owner>(wall));
      }
    }
  }
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    for (const lattice::Axial part : state.shape(particle).sites()) {
      const lattice::Site site = particle.site() + part;
      if (!lattice.contains(site)) {
        throw std::invalid_argument("a particle leaves the box");
      }
      take_free(*this, lattice.index(site), static_cast<Owner>(id));
    }
  }
}

}  // namespace clca::automaton
