#include "grains/internal/wall_edges.hpp"

#include <algorithm>

namespace clca::grains {

namespace {

/// The sites that `wall` newly covers after one step in `direction`.
/// For the opposite direction these are the sites that it leaves.
class Outline {
 public:
  Outline(const lattice::Lattice& lattice, const Wall& wall) : lattice_(lattice) {
    for (const lattice::Site site : wall.sites) {
      sites_.push_back(canonical(site));
    }
    std::sort(sites_.begin(), sites_.end());
    sites_.erase(std::unique(sites_.begin(), sites_.end()), sites_.end());
  }

  std::vector<lattice::Site> lead(lattice::Direction direction) const {
    std::vector<lattice::Site> result;
    for (const lattice::Site site : sites_) {
      const lattice::Site next = site + unit(direction);
      if (!covers(next)) {
        result.push_back(next);
      }
    }
    return result;
  }
  std::vector<lattice::Site> trail(lattice::Direction direction) const {
    std::vector<lattice::Site> result;
    std::copy_if(sites_.begin(), sites_.end(), std::back_inserter(result),
                 [&](lattice::Site site) { return !covers(site + unit(opposite(direction))); });
    return result;
  }

 private:
  lattice::Site canonical(lattice::Site site) const {
    return {lattice_.wrapped(site.column), site.row};
  }
  bool covers(lattice::Site site) const {
    return std::binary_search(sites_.begin(), sites_.end(), canonical(site));
  }

  const lattice::Lattice& lattice_;
  std::vector<lattice::Site> sites_;
};

std::vector<std::size_t> indices(const lattice::Lattice& lattice,
                                 const std::vector<lattice::Site>& home, lattice::Axial shift) {
  std::vector<std::size_t> result;
  for (const lattice::Site site : home) {
    if (lattice.contains(site + shift)) {
      result.push_back(lattice.index(site + shift));
    }
  }
  return result;
}

}  // namespace

WallEdges::WallEdges(const State& state) : edges_(state.walls.size()) {
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (!state.walls[wall].motion) {
      continue;
    }
    const Outline outline(state.lattice, state.walls[wall]);
    const lattice::Direction forward = state.walls[wall].motion->direction;
    const lattice::Direction back = opposite(forward);
    edges_[wall] = {Edge{outline.lead(forward), outline.trail(forward)},
                    Edge{outline.lead(back), outline.trail(back)}};
  }
}

WallStep WallEdges::step_of(const State& state, std::size_t number, int desired) const {
  const Wall& wall = state.walls[number];
  const lattice::Direction forward = wall.motion->direction;
  const lattice::Axial shift = wall.shift();
  const Edge& sides = edges_[number][desired > 0 ? 0 : 1];
  return {.wall = number,
          .direction = desired > 0 ? forward : opposite(forward),
          .enters = indices(state.lattice, sides.lead, shift),
          .leaves = indices(state.lattice, sides.trail, shift)};
}

}  // namespace clca::grains
