#include "grains/internal/wall_edges.hpp"

#include <algorithm>
#include <iterator>

namespace clca::grains {

namespace {

lattice::Site in_box(const lattice::Lattice& lattice, lattice::Site site) {
  return {lattice.wrapped(site.column), site.row};
}

/// Sorted, each once.
std::vector<lattice::Site> home_sites(const lattice::Lattice& lattice, const Wall& wall) {
  std::vector<lattice::Site> sites;
  for (const lattice::Site site : wall.sites) {
    sites.push_back(in_box(lattice, site));
  }
  std::ranges::sort(sites);
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

/// Those of the sorted sites that have none of them next to them in this direction.
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

WallEdges::WallEdges(const State& state) : edges_(state.walls.size()) {
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (const auto& motion = state.walls[wall].motion) {
      const std::vector<lattice::Site> sites = home_sites(state.lattice, state.walls[wall]);
      edges_[wall] = {edge(state.lattice, sites, motion->direction),
                      edge(state.lattice, sites, opposite(motion->direction))};
    }
  }
}

WallStep WallEdges::step_of(const State& state, std::size_t number, int desired) const {
  const Wall& wall = state.walls[number];
  const std::size_t ahead = desired > 0 ? 0 : 1;
  const lattice::Direction forward = wall.motion->direction;
  const lattice::Direction direction = desired > 0 ? forward : opposite(forward);
  return {.wall = number,
          .direction = direction,
          .enters = indices(state.lattice, edges_[number][ahead], wall.shift() + unit(direction)),
          .leaves = indices(state.lattice, edges_[number][1 - ahead], wall.shift())};
}

}  // namespace clca::grains
