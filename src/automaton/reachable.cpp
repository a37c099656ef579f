// What a state that was loaded has to keep to, so that nobody who works with it goes astray.

#include <algorithm>
#include <stdexcept>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

namespace {

void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::invalid_argument(reason);
  }
}

/// Columns run on across a periodic seam; no run comes near to what an int holds.
constexpr std::int32_t kFarthest = 1 << 29;

bool in_reach(lattice::Site site) {
  const auto near = [](int place) { return place > -kFarthest && place < kFarthest; };
  return near(site.column) && near(site.row);
}

void check_particles(const State& state) {
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
  require(state.particles.size() < std::size_t{kFarthest}, "there are too many particles");
  for (const Particle& particle : state.particles) {
    require(particle.kind < state.kinds.size(), "a particle is of no kind");
    require(particle.previous <= kRest, "a particle has moved nowhere");
    require(in_reach(particle.site()), "a particle is too far away");
  }
  require(std::all_of(state.origins.begin(), state.origins.end(), in_reach),
          "an origin is too far away");
}

void check_wall(const Wall& wall) {
  if (!wall.motion) {
    require(wall.travel == Travel{}, "a wall without motion has moved");
    return;
  }
  const Range range = range_of(*wall.motion);
  require(wall.travel.offset >= range.low && wall.travel.offset <= range.high,
          "a wall is where its motion never comes to");
  require(wall.travel.phase <= Travel::Phase::waiting, "a wall is in no phase");
}

void check_pushes(const State& state) {
  const auto exists = [&](Owner owner) {
    return is_particle(owner) ? static_cast<std::size_t>(owner) < state.particles.size()
                              : is_wall(owner) && wall_number(owner) < state.walls.size();
  };
  for (const Push& push : state.pushes) {
    require(push.pushed < state.particles.size() && exists(push.pusher) &&
                push.source < state.walls.size() &&
                lattice::index_of(push.direction) < lattice::kDirectionCount,
            "a push is between nobody");
  }
  const bool ascending =
      std::adjacent_find(state.pushes.begin(), state.pushes.end(),
                         [](const Push& a, const Push& b) {
                           return std::pair(a.pushed, a.pusher) >= std::pair(b.pushed, b.pusher);
                         }) == state.pushes.end();
  require(ascending, "pushes are out of order");
}

}  // namespace

void check_reachable(const State& state, const State& beginning) {
  require(state.walls.size() == beginning.walls.size() &&
              state.sources.size() == beginning.sources.size() &&
              state.outlets.size() == beginning.outlets.size(),
          "walls, sources or outlets are not those of the scene");
  require(state.seed == beginning.seed, "the seed is not that of the scene");
  check_particles(state);
  for (const Wall& wall : state.walls) {
    check_wall(wall);
  }
  check_pushes(state);
}

}  // namespace clca::automaton
