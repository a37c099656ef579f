#include "grains/internal/occupancy_table.hpp"

#include <algorithm>
#include <stdexcept>

#include "lattice/internal/require.hpp"

namespace clca::grains {

namespace {

/// Whether the particle `id` may overlap `owner`.
bool may_share(const State& state, std::uint32_t id, Owner owner) {
  return find_push(state, id, owner) != nullptr ||
         (is_particle(owner) && find_push(state, particle_id(owner), as_owner(id)) != nullptr);
}

void put(OccupancyTable& occupancy, const State& state, std::size_t index, std::uint32_t id) {
  if (!occupancy.is_taken(index)) {
    occupancy.take(index, as_owner(id));
    return;
  }
  require(occupancy.second_owner(index) == kFree && may_share(state, id, occupancy.owner(index)),
          "two particles overlap, or a particle overlaps a wall");
  occupancy.add_owner(index, as_owner(id));
}

void put_wall(OccupancyTable& occupancy, const State& state, std::size_t number) {
  const Wall& wall = state.walls[number];
  for (const lattice::Site site : wall.sites) {
    require(wall.motion || state.lattice.contains(site), "a wall leaves the box");
  }
  if (!wall.present) {
    return;
  }
  for (const lattice::Site site : current_sites(state.lattice, wall)) {
    const std::size_t index = state.lattice.index(site);
    const Owner other = occupancy.owner(index);
    require(!is_obstacle(other) || (!wall.motion && !state.walls[wall_number(other)].motion),
            "a wall that moves stands in another wall");
    occupancy.take(index, wall_code(number));
  }
}

void take_border(OccupancyTable& occupancy, const lattice::Lattice& lattice) {
  const int beside = lattice.periodic() ? 0 : 1;  // of a periodic box they are never read
  for (int column = -beside; column < lattice.columns() + beside; ++column) {
    occupancy.take(lattice.index({column, -1}), kBorder);
    occupancy.take(lattice.index({column, lattice.rows()}), kBorder);
  }
  if (lattice.periodic()) {
    return;
  }
  for (int row = 0; row < lattice.rows(); ++row) {
    occupancy.take(lattice.index({-1, row}), kBorder);
    occupancy.take(lattice.index({lattice.columns(), row}), kBorder);
  }
}

}  // namespace

OccupancyTable::OccupancyTable(const State& state)
    : taken_(state.lattice),
      inverted_memory_(state.lattice.index_count()),
      second_memory_(walls_may_overlap(state) ? state.lattice.index_count() : 0, kFree) {
  inverted_owners_ = {inverted_memory_.data(), inverted_memory_.size()};
  second_owners_ = second_memory_;
  const lattice::Lattice& lattice = state.lattice;
  take_border(*this, lattice);
  for (const Kind& kind : state.kinds) {
    const int columns = kind.shape.sites().back().x - kind.shape.sites().front().x + 1;
    require(!lattice.periodic() || columns < lattice.columns(),
            "a kind is as wide as the periodic box");  // it would block itself
  }
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    put_wall(*this, state, wall);
  }
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    for (const lattice::Axial offset : state.shape(particle).sites()) {
      const lattice::Site site = particle.site() + offset;
      require(lattice.contains(site), "a particle leaves the box");
      put(*this, state, lattice.index(site), static_cast<std::uint32_t>(id));
    }
  }
}

void OccupancyTable::add_owner(std::size_t index, Owner owner) {
  if (!is_taken(index)) {
    take(index, owner);
    return;
  }
  if (second_owners_.empty() || second_owners_[index] != kFree) {
    throw std::logic_error("a site cannot have another owner");
  }
  const Owner first = this->owner(index);
  set_owner(index, std::min(first, owner));
  second_owners_[index] = std::max(first, owner);
}

bool OccupancyTable::remove_owner(std::size_t index, Owner owner) {
  if (second_owner(index) == kFree) {
    release(index);
    return true;
  }
  if (this->owner(index) == owner) {
    set_owner(index, second_owners_[index]);
  }
  second_owners_[index] = kFree;
  return false;
}

Occupancy::Occupancy(const State& state)
    : table_(std::make_shared<const OccupancyTable>(state)),
      inverted_owners_(table_->inverted_owners_),
      second_owners_(table_->second_owners_) {}

bool Occupancy::operator==(const Occupancy& other) const {
  return std::ranges::equal(inverted_owners_, other.inverted_owners_) &&
         std::ranges::equal(second_owners_, other.second_owners_);
}

}  // namespace clca::grains
