#include "clca/grains/state.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "clca/reflection/hash.hpp"
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
         (!shake.period || (*shake.period > 0 &&
                            *shake.period <= static_cast<std::uint64_t>(kMotionUnitsPerSpacing)));
}
bool can_be_carried_out(const Path& path) {
  Path::Point last;
  return std::ranges::all_of(path.points, [&](const Path::Point& point) {
    const Path::Point before = std::exchange(last, point);
    return point.step > before.step && in_reach({point.offset, 0}) && !is_too_steep(before, point);
  });
}

bool is_direction(lattice::Direction direction) {
  return lattice::index_of(direction) < lattice::kDirectionCount;
}

}  // namespace

Eigen::Vector2d centre(const State& state, const Particle& particle) {
  return lattice::position(particle.site()) + state.shape(particle).centroid();
}

Eigen::Vector2d centre_in_box(const State& state, const Particle& particle) {
  const lattice::Site site = {state.lattice.wrapped(particle.column), particle.row};
  return state.lattice.image_in_box(lattice::position(site) + state.shape(particle).centroid());
}

lattice::Axial Wall::shift() const {
  if (!motion) {
    return {};
  }
  const lattice::Axial unit_vector = unit(motion->direction);
  return {travel.offset * unit_vector.x, travel.offset * unit_vector.q};
}

std::vector<lattice::Site> current_sites(const lattice::Lattice& lattice, const Wall& wall) {
  const lattice::Axial shift = wall.shift();
  std::vector<lattice::Site> sites;
  sites.reserve(wall.sites.size());
  for (const lattice::Site home : wall.sites) {
    const lattice::Site site = home + shift;
    if (lattice.contains(site)) {
      sites.push_back({lattice.wrapped(site.column), site.row});
    }
  }
  return sites;
}

bool walls_may_overlap(const State& state) {
  return std::ranges::any_of(state.walls, [](const Wall& wall) { return wall.lets_overlap(); });
}

std::size_t present_count(const State& state) {
  return static_cast<std::size_t>(
      std::ranges::count_if(state.particles, [](const Particle& p) { return p.present; }));
}

const Push* find_push(const State& state, std::uint32_t pushed, Owner pusher) {
  const std::pair key(pushed, pusher);
  const auto found =
      std::ranges::lower_bound(state.pushes, key, {}, [](const Push& push) { return push.key(); });
  return found != state.pushes.end() && found->key() == key ? &*found : nullptr;
}

std::uint64_t hash(const State& state) {
  return reflection::hash(state);
}

void check_valid(const State& state) {
  require(state.kinds.size() <= std::numeric_limits<std::uint16_t>::max(),
          "there are too many kinds");
  for (const Kind& kind : state.kinds) {
    require(kind.shape.contains({}), "the reference site of a kind is not one of its sites");
  }
  require(state.particles.size() < std::size_t{kMaxCoordinate}, "there are too many particles");
  for (const Particle& particle : state.particles) {
    require(particle.kind < state.kinds.size(), "a particle is of no kind");
    require(particle.previous <= kRest, "the last move of a particle is out of range");
    require(in_reach(particle.site()), "a particle is too far away");
  }
  require(std::ranges::all_of(state.origins, in_reach), "an origin is too far away");
  for (const Wall& wall : state.walls) {
    require(std::ranges::all_of(wall.sites, in_reach), "a site of a wall is too far away");
    if (!wall.motion) {
      require(wall.travel == Travel{}, "a wall without motion has moved");
      continue;
    }
    require(is_direction(wall.motion->direction) &&
                std::visit([](const auto& program) { return can_be_carried_out(program); },
                           wall.motion->program),
            "the motion of a wall cannot be carried out");
    const OffsetRange range = offset_range(*wall.motion);
    require(wall.travel.offset >= range.low && wall.travel.offset <= range.high,
            "a wall is where its motion never goes");
    require(wall.travel.phase <= Travel::Phase::waiting, "a wall is in no phase");
  }
  for (const Source& source : state.sources) {
    require(!source.sites.empty(), "a source has no sites");
    require(std::ranges::all_of(source.sites, in_reach), "a site of a source is too far away");
    require(source.weights.size() == state.kinds.size(),
            "a source has not one weight for each kind");
    require(std::ranges::any_of(source.weights, [](std::uint32_t weight) { return weight > 0; }),
            "all weights of a source are 0");
  }
  const auto exists = [&](Owner owner) {
    return is_particle(owner) ? particle_id(owner) < state.particles.size()
                              : is_obstacle(owner) && wall_number(owner) < state.walls.size();
  };
  for (const Push& push : state.pushes) {
    require(push.pushed < state.particles.size() && exists(push.pusher) &&
                push.source < state.walls.size() && is_direction(push.direction),
            "a push names a particle, wall or direction that does not exist");
  }
  require(std::ranges::adjacent_find(state.pushes, std::ranges::greater_equal(), &Push::key) ==
              state.pushes.end(),
          "pushes are out of order");
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
