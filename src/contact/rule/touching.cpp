#include "contact/rule/touching.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "contact/rule/surfaces.hpp"
#include "grains/internal/separation.hpp"

namespace clca::contact {

namespace {

using lattice::Axial;

/// Of 45 degrees, see cosine(). The normals of one straight wall are at most 30 degrees apart.
constexpr std::int64_t kLeastCosine = std::int64_t{759'250'125} << kUnitBits;

/// What blocks a grain, by body: grains, walls and sides.
std::map<grains::Owner, Obstacle> blocking(const grains::Box& box, std::uint32_t id) {
  const grains::State& state = box.state;
  const grains::Particle& grain = state.particles[id];
  std::map<grains::Owner, Obstacle> result;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::size_t d = lattice::index_of(direction);
    box.for_each_index(grain, box.footprints.of(grain).lead[d], [&](std::size_t index) {
      grains::Owner owner = box.occupancy.owner(index);
      if (owner == grains::kFree) {
        return;
      }
      const lattice::Site site = state.lattice.site(index);
      if (owner == grains::kBorder) {
        owner = body_at(box, site);
      }
      Obstacle& obstacle = result[owner];
      obstacle.body = owner;
      obstacle.directions |= 1U << d;
      if (!grains::is_particle(owner)) {
        obstacle.sites.push_back(grains::nearest_vector(state.lattice, grain.site(), site));
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

/// The bodies of a surface that get contacts of their own: of those with one velocity a wall before
/// a side, with most touched sites, with the lowest code.
std::vector<grains::Owner> bodies_of_contacts(const std::vector<Obstacle>& surface,
                                              const WallVelocities& walls) {
  const auto velocity = [&](const Obstacle* obstacle) {
    return is_side(obstacle->body) ? WallVelocities::value_type()
                                   : walls[grains::wall_number(obstacle->body)];
  };
  const auto rank = [](const Obstacle& obstacle) {
    return std::tuple(!is_side(obstacle.body), obstacle.sites.size(), -std::int64_t{obstacle.body});
  };
  std::vector<const Obstacle*> chosen;
  for (const Obstacle& obstacle : surface) {
    const auto alike = std::find_if(chosen.begin(), chosen.end(), [&](const Obstacle* other) {
      return velocity(other) == velocity(&obstacle);
    });
    if (alike == chosen.end()) {
      chosen.push_back(&obstacle);
    } else if (rank(obstacle) > rank(**alike)) {
      *alike = &obstacle;
    }
  }
  std::vector<grains::Owner> result;
  std::transform(chosen.begin(), chosen.end(), std::back_inserter(result),
                 [](const Obstacle* obstacle) { return obstacle->body; });
  return result;
}

}  // namespace

WallTouches wall_touches(const grains::Box& box, std::uint32_t id, const WallVelocities& walls) {
  std::vector<Obstacle> obstacles;
  for (auto& [owner, obstacle] : blocking(box, id)) {
    if (!grains::is_particle(owner)) {
      obstacles.push_back(std::move(obstacle));
    }
  }
  WallTouches result{.touches = {}, .several_bodies = obstacles.size() > 1};
  for (const std::vector<Obstacle>& surface : surfaces(box, box.state.particles[id], obstacles)) {
    unsigned directions = 0;
    for (const Obstacle& obstacle : surface) {
      directions |= obstacle.directions;
    }
    const Axial blocked = sum(directions);
    if (blocked == Axial()) {
      continue;
    }
    for (const grains::Owner body : bodies_of_contacts(surface, walls)) {
      result.touches.push_back(
          {.contact = {.upper = id, .other = body, .normal = unit_vector(Axial() - blocked)}});
    }
  }
  std::sort(result.touches.begin(), result.touches.end(), [](const Touch& one, const Touch& other) {
    return one.contact.other < other.contact.other;
  });
  return result;
}

std::vector<std::size_t> followed_by(std::span<const Contact> before, std::span<const Touch> now) {
  // The best first. Whether the body is the same counts last: a surface may have several.
  using Match = std::tuple<bool, std::int64_t, bool, std::size_t, std::size_t>;
  std::vector<Match> matches;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = 0; k < now.size(); ++k) {
      const Contact& next = now[k].contact;
      const std::int64_t like = cosine(before[i].normal, next.normal);
      if (like > kLeastCosine) {
        matches.emplace_back(is_side(before[i].other) == is_side(next.other), like,
                             before[i].other == next.other, i, k);
      }
    }
  }
  std::sort(matches.begin(), matches.end(), std::greater());
  std::vector<std::size_t> result(before.size(), kNoTouch);
  std::vector<bool> taken(now.size(), false);
  for (const auto& [same_kind, like, same_body, i, k] : matches) {
    if (result[i] == kNoTouch && !taken[k]) {
      result[i] = k;
      taken[k] = true;
    }
  }
  return result;
}

std::vector<Touch> touches(const grains::Box& box, lattice::Direction down, NormalTable& normals,
                           const WallVelocities& walls) {
  const grains::State& state = box.state;
  std::vector<Touch> result;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (!grain.present) {
      continue;
    }
    const std::vector<Touch> at_walls = wall_touches(box, id, walls).touches;
    result.insert(result.end(), at_walls.begin(), at_walls.end());
    for (const auto& [owner, obstacle] : blocking(box, id)) {
      const auto other = grains::particle_id(owner);
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
