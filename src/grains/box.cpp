#include "grains/internal/box.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "grains/internal/filling.hpp"

namespace clca::grains {

namespace {

lattice::Site in_box(const lattice::Lattice& lattice, lattice::Site site) {
  return {lattice.wrapped(site.column), site.row};
}

/// The sites of a wall at its initial position, sorted, each once.
std::vector<lattice::Site> initial_sites(const lattice::Lattice& lattice, const Wall& wall) {
  std::vector<lattice::Site> sites;
  for (const lattice::Site site : wall.sites) {
    sites.push_back(in_box(lattice, site));
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

/// The sites whose neighbour in this direction is none of the sorted `sites`.
std::vector<lattice::Site> edge(const lattice::Lattice& lattice,
                                const std::vector<lattice::Site>& sites,
                                lattice::Direction direction) {
  std::vector<lattice::Site> result;
  std::ranges::copy_if(sites, std::back_inserter(result), [&](lattice::Site site) {
    return !std::binary_search(sites.begin(), sites.end(), in_box(lattice, site + unit(direction)));
  });
  return result;
}

std::vector<std::size_t> indices(const lattice::Lattice& lattice,
                                 const std::vector<lattice::Site>& sites, lattice::Axial shift) {
  std::vector<std::size_t> result;
  for (const lattice::Site site : sites) {
    if (lattice.contains(site + shift)) {
      result.push_back(lattice.index(site + shift));
    }
  }
  return result;
}

}  // namespace

std::vector<lattice::IndexOffset> index_offsets(const lattice::Lattice& lattice,
                                                const std::vector<lattice::Axial>& sites,
                                                bool odd_column) {
  std::vector<lattice::IndexOffset> result;
  result.reserve(sites.size());
  for (const lattice::Axial site : sites) {
    result.push_back(lattice.index_offset(site, odd_column));
  }
  return result;
}

FootprintTable::FootprintTable(const State& state) {
  for (const Kind& kind : state.kinds) {
    for (const bool odd_column : {false, true}) {
      Footprint& footprint = table_.emplace_back();
      footprint.covered = index_offsets(state.lattice, kind.shape.sites(), odd_column);
      std::set<lattice::Axial> ring;
      for (const lattice::Direction direction : lattice::kDirections) {
        const std::size_t d = index_of(direction);
        const std::vector<lattice::Axial> lead = kind.shape.lead_sites(direction);
        ring.insert(lead.begin(), lead.end());
        footprint.lead_sites[d] = index_offsets(state.lattice, lead, odd_column);
        footprint.trail_sites[d] =
            index_offsets(state.lattice, kind.shape.trail_sites(direction), odd_column);
      }
      footprint.neighbours = index_offsets(state.lattice, {ring.begin(), ring.end()}, odd_column);
    }
  }
}

WallEdges::WallEdges(const State& state) : edges_(state.walls.size()) {
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (const auto& motion = state.walls[wall].motion) {
      const std::vector<lattice::Site> sites = initial_sites(state.lattice, state.walls[wall]);
      edges_[wall] = {edge(state.lattice, sites, motion->direction),
                      edge(state.lattice, sites, opposite(motion->direction))};
    }
  }
}

WallStep WallEdges::wall_step(const State& state, std::size_t number, int desired) const {
  const Wall& wall = state.walls[number];
  const std::size_t ahead = desired > 0 ? 0 : 1;
  const lattice::Direction forward = wall.motion->direction;
  const lattice::Direction direction = desired > 0 ? forward : opposite(forward);
  return {.wall = number,
          .direction = direction,
          .entered = indices(state.lattice, edges_[number][ahead], wall.shift() + unit(direction)),
          .vacated = indices(state.lattice, edges_[number][1 - ahead], wall.shift())};
}

std::optional<std::vector<std::uint32_t>> pushed_particles(const Box& box, const WallStep& step) {
  std::vector<bool> included(box.state.particles.size(), false);
  std::vector<std::uint32_t> ids;
  bool blocked = false;
  const auto add_owners = [&](std::size_t index) {
    for (const Owner owner : {box.occupancy.owner(index), box.occupancy.second_owner(index)}) {
      if (!is_particle(owner)) {
        blocked = blocked || (owner != kFree && owner != wall_code(step.wall));
      } else if (!included[particle_id(owner)]) {
        included[particle_id(owner)] = true;
        ids.push_back(particle_id(owner));
      }
    }
  };
  std::ranges::for_each(step.entered, add_owners);
  for (std::size_t i = 0; i < ids.size() && !blocked; ++i) {
    const Particle& particle = box.state.particles[ids[i]];
    box.for_each_entered(particle, step.direction, add_owners);
    box.for_each_index(particle, add_owners);
  }
  return blocked ? std::nullopt : std::optional(std::move(ids));
}

std::size_t enclosing_outlet(const State& state, const Particle& particle) {
  const auto outlet = std::ranges::find_if(state.outlets, [&](const Outlet& candidate) {
    return lies_inside(state, particle, candidate.region);
  });
  return static_cast<std::size_t>(outlet - state.outlets.begin());
}

bool count_at_outlet(State& state, std::uint32_t id) {
  const Particle& particle = state.particles[id];
  if (!particle.present) {
    return false;
  }
  const std::size_t outlet = enclosing_outlet(state, particle);
  if (outlet == state.outlets.size()) {
    return false;
  }
  ++state.outlets[outlet].particles;
  state.outlets[outlet].sites += state.shape(particle).size();
  return true;
}

}  // namespace clca::grains
