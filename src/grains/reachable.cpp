// Checks that a loaded state is one that a run can reach.

#include <algorithm>
#include <limits>
#include <utility>

#include "clca/grains/state.hpp"
#include "lattice/internal/require.hpp"

namespace clca::grains {

namespace {

/// Columns are not wrapped at a periodic boundary; no run comes near the limit of int.
constexpr std::int32_t kMaxCoordinate = 1 << 29;

bool in_reach(lattice::Site site) {
  const auto near = [](int coordinate) {
    return coordinate > -kMaxCoordinate && coordinate < kMaxCoordinate;
  };
  return near(site.column) && near(site.row);
}

void check_particles(const State& state) {
  require(state.particles.size() < std::size_t{kMaxCoordinate}, "there are too many particles");
  for (const Particle& particle : state.particles) {
    require(particle.kind < state.kinds.size(), "a particle is of no kind");
    require(particle.previous <= kRest, "the last move of a particle is out of range");
    require(in_reach(particle.site()), "a particle is too far away");
  }
  require(std::ranges::all_of(state.origins, in_reach), "an origin is too far away");
}

void check_kinds(const State& state) {
  require(state.kinds.size() <= std::numeric_limits<std::uint16_t>::max(),
          "there are too many kinds");
  for (const Kind& kind : state.kinds) {
    require(kind.shape.contains({}), "the reference site of a kind is not one of its sites");
  }
}

bool can_be_carried_out(const Drive& drive) {
  return drive.period > 0 && drive.distance >= 0 && drive.distance < kMaxCoordinate;
}
bool can_be_carried_out(const Wave& wave) {
  // target() takes 4 x amplitude x period squared in 64 bits.
  return wave.period > 0 && wave.period <= 10'000'000 && wave.amplitude >= 0 &&
         wave.amplitude <= 10'000 && wave.period >= least_period(wave);
}
bool can_be_carried_out(const Shake& shake) {
  return shake.amplitude >= 0 && shake.amplitude < kMaxCoordinate &&
         (!shake.period ||
          (*shake.period > 0 && *shake.period <= static_cast<std::uint64_t>(kMotionSpacing)));
}
bool can_be_carried_out(const Path& path) {
  Path::Point last;
  return std::ranges::all_of(path.points, [&](const Path::Point& point) {
    const Path::Point before = std::exchange(last, point);
    return point.step > before.step && in_reach({point.offset, 0}) && !is_steep(before, point);
  });
}

bool is_direction(lattice::Direction direction) {
  return lattice::index_of(direction) < lattice::kDirectionCount;
}

void check_wall(const Wall& wall) {
  require(std::ranges::all_of(wall.sites, in_reach), "a site of a wall is too far away");
  if (!wall.motion) {
    require(wall.travel == Travel{}, "a wall without motion has moved");
    return;
  }
  require(is_direction(wall.motion->direction) &&
              std::visit([](const auto& program) { return can_be_carried_out(program); },
                         wall.motion->program),
          "the motion of a wall cannot be carried out");
  const OffsetRange range = range_of(*wall.motion);
  require(wall.travel.offset >= range.low && wall.travel.offset <= range.high,
          "a wall is where its motion never goes");
  require(wall.travel.phase <= Travel::Phase::waiting, "a wall is in no phase");
}

void check_pushes(const State& state) {
  const auto exists = [&](Owner owner) {
    return is_particle(owner) ? particle_id(owner) < state.particles.size()
                              : is_wall(owner) && wall_number(owner) < state.walls.size();
  };
  for (const Push& push : state.pushes) {
    require(push.pushed < state.particles.size() && exists(push.pusher) &&
                push.source < state.walls.size() && is_direction(push.direction),
            "a push names a particle, wall or direction that does not exist");
  }
  const bool ascending = std::ranges::adjacent_find(state.pushes, [](const Push& a, const Push& b) {
                           return a.key() >= b.key();
                         }) == state.pushes.end();
  require(ascending, "pushes are out of order");
}

void check_source(const Source& source, std::size_t kinds) {
  require(!source.sites.empty(), "a source has no sites");
  require(std::ranges::all_of(source.sites, in_reach), "a site of a source is too far away");
  require(source.weights.size() == kinds, "a source has not one weight for each kind");
  require(std::ranges::any_of(source.weights, [](std::uint32_t weight) { return weight > 0; }),
          "all weights of a source are 0");
}

}  // namespace

void check_valid(const State& state) {
  check_kinds(state);
  check_particles(state);
  for (const Wall& wall : state.walls) {
    check_wall(wall);
  }
  for (const Source& source : state.sources) {
    check_source(source, state.kinds.size());
  }
  check_pushes(state);
}

void check_one_site(const State& state) {
  for (const Kind& kind : state.kinds) {
    require(kind.shape.size() == 1, "grains of this model have one site");
  }
  for (const Wall& wall : state.walls) {
    require(!wall.motion, "this model has no walls that move");
  }
  require(state.pushes.empty(), "this model has no walls that move");
}

void check_reachable(const State& state, const State& beginning) {
  require(state.walls.size() == beginning.walls.size() &&
              state.sources.size() == beginning.sources.size() &&
              state.outlets.size() == beginning.outlets.size(),
          "walls, sources or outlets are not those of the scene");
  require(state.seed == beginning.seed, "the seed is not that of the scene");
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
  check_valid(state);
}

}  // namespace clca::grains
