#include "automaton/wall_mover.hpp"

#include <algorithm>

namespace clca::automaton {

namespace {

/// The sites of `wall` one step in `direction`, those that it does not cover itself; against the
/// direction: those that it covers no more afterwards, as seen before the step.
class Outline {
 public:
  Outline(const lattice::Lattice& lattice, const grains::Wall& wall) : lattice_(lattice) {
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

std::vector<std::size_t> places(const lattice::Lattice& lattice,
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

WallMover::WallMover(const grains::State& state) : edges_(state.walls.size()) {
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

void WallMover::advance(World& world, StepReport& report) {
  world.carried.clear();
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    grains::Wall& wall = world.state.walls[number];
    if (!wall.motion || !wall.present || !wall.travel.active) {
      continue;
    }
    const int wished = wish(*wall.motion, wall.travel);
    bool done = false;
    if (wished != 0) {
      const WallStep step = step_of(world.state, number, wished);
      done = wall.passive == grains::Passive::rigid ? push_along(world, step) : enter(world, step);
      ++(done ? report.walls_moved : report.walls_stalled);
    }
    take_step(*wall.motion, wall.travel, wished, done, world.state.step);
  }
}

void WallMover::end_step(World& world, bool particles_moved) {
  for (grains::Wall& wall : world.state.walls) {
    if (wall.motion && wall.present && wall.travel.active) {
      grains::end_step(*wall.motion, wall.travel, particles_moved);
    }
  }
}

bool WallMover::is_still(World& world) const {
  for (std::size_t number = 0; number < world.state.walls.size(); ++number) {
    const grains::Wall& wall = world.state.walls[number];
    if (!wall.motion || !wall.present || !wall.travel.active ||
        is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const int wished = lasting_wish(*wall.motion, wall.travel);
    if (wished == 0 || !wall.travel.stalled_since ||
        can_take(world, step_of(world.state, number, wished))) {
      return false;
    }
  }
  return true;
}

WallStep WallMover::step_of(const grains::State& state, std::size_t number, int wished) const {
  const grains::Wall& wall = state.walls[number];
  const lattice::Direction forward = wall.motion->direction;
  const lattice::Axial shift = wall.shift();
  const Edge& sides = edge(number, wished > 0);
  return {.wall = number,
          .direction = wished > 0 ? forward : opposite(forward),
          .enters = places(state.lattice, sides.lead, shift),
          .leaves = places(state.lattice, sides.trail, shift)};
}

}  // namespace clca::automaton
