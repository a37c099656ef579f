#include "support/overlaps.hpp"

#include <algorithm>

namespace clca::testing {

using grains::is_obstacle;
using grains::is_particle;
using grains::Owner;
using grains::Particle;
using grains::Push;
using grains::State;
using lattice::Axial;
using lattice::Direction;
using lattice::Site;

namespace {

Sites moved(const State& state, const Sites& sites, Axial by) {
  Sites result;
  for (const Site site : sites) {
    const Site target = site + by;
    result.insert({state.lattice.wrapped(target.column), target.row});
  }
  return result;
}

bool crowded(const State& state, const std::set<Owner>& owners) {
  const bool closed = std::any_of(owners.begin(), owners.end(), [&](Owner owner) {
    return is_obstacle(owner) && !state.walls[grains::wall_number(owner)].lets_overlap();
  });
  return owners.size() > 2 || (owners.size() == 2 && closed && is_particle(*owners.rbegin()));
}

bool in_order(const std::vector<Push>& pushes) {
  return std::is_sorted(pushes.begin(), pushes.end(), [](const Push& a, const Push& b) {
    return std::pair(a.pushed, a.pusher) < std::pair(b.pushed, b.pusher);
  });
}

/// The pairs of `all` that are not among `some`, in words.
std::string missing(const Pairs& all, const Pairs& some) {
  std::string words;
  for (const auto& [one, other] : all) {
    if (!some.contains({one, other})) {
      words += " " + std::to_string(one) + " and " + std::to_string(other);
    }
  }
  return words;
}

}  // namespace

Sites body(const State& state, const Particle& particle) {
  Sites sites;
  for (const Axial part : state.shape(particle).sites()) {
    const Site site = particle.site() + part;
    sites.insert({state.lattice.wrapped(site.column), site.row});
  }
  return sites;
}

Sites body_after(const State& state, const Particle& particle, Direction direction) {
  return moved(state, body(state, particle), unit(direction));
}

Sites wall_body(const State& state, std::size_t number, int offset) {
  const grains::Wall& wall = state.walls[number];
  Sites sites;
  for (Site site : wall.sites) {
    if (wall.motion) {
      const Axial one = unit(wall.motion->direction);
      site = site + Axial{offset * one.x, offset * one.q};
    }
    if (state.lattice.contains(site)) {
      sites.insert({state.lattice.wrapped(site.column), site.row});
    }
  }
  return sites;
}

Sites body_of(const State& state, Owner owner) {
  if (is_obstacle(owner)) {
    const std::size_t number = grains::wall_number(owner);
    return wall_body(state, number, state.walls[number].travel.offset);
  }
  return body(state, state.particles[grains::particle_id(owner)]);
}

bool inside(const State& state, const Sites& sites) {
  return std::all_of(sites.begin(), sites.end(),
                     [&](Site site) { return state.lattice.contains(site); });
}

int shared(const Sites& one, const Sites& other) {
  return static_cast<int>(
      std::count_if(one.begin(), one.end(), [&](Site site) { return other.contains(site); }));
}

int depth(const State& state, const Sites& one, const Sites& other, int most) {
  std::set<Axial> reached = {{0, 0}};
  for (int moves = 0; moves < most; ++moves) {
    std::set<Axial> next;
    for (const Axial by : reached) {
      if (shared(moved(state, one, by), other) == 0) {
        return moves;
      }
      for (const Direction direction : lattice::kDirections) {
        next.insert(by + unit(direction));
      }
    }
    reached = std::move(next);
  }
  return most;
}

std::map<Site, std::set<Owner>> occupants(const State& state) {
  std::map<Site, std::set<Owner>> owners;
  const auto put = [&](Owner owner) {
    for (const Site site : body_of(state, owner)) {
      owners[site].insert(owner);
    }
  };
  for (std::size_t number = 0; number < state.walls.size(); ++number) {
    if (state.walls[number].present) {
      put(grains::wall_code(number));
    }
  }
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present) {
      put(grains::as_owner(id));
    }
  }
  return owners;
}

Pairs overlapping_pairs(const State& state) {
  Pairs pairs;
  for (const auto& [site, owners] : occupants(state)) {
    for (const Owner one : owners) {
      for (const Owner other : owners) {
        if (one < other && is_particle(other)) {
          pairs.insert({one, other});
        }
      }
    }
  }
  return pairs;
}

std::string complaint(const State& state) {
  for (const auto& [site, owners] : occupants(state)) {
    if (crowded(state, owners)) {
      return "a site is crowded";
    }
  }
  Pairs pushed;
  for (const Push& push : state.pushes) {
    if (!pushed.insert(std::minmax(grains::as_owner(push.pushed), push.pusher)).second) {
      return "a pair has two pushes";
    }
    if (!state.walls.at(push.source).lets_overlap()) {
      return "a push comes from a wall that does not overlap";
    }
  }
  const auto pairs = overlapping_pairs(state);
  if (pairs != pushed) {
    return "pairs without a push:" + missing(pairs, pushed) +
           "; pushes of no pair:" + missing(pushed, pairs);
  }
  if (!in_order(state.pushes)) {
    return "pushes are out of order";
  }
  const bool deep = std::any_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
    return is_particle(pair.first) &&
           depth(state, body_of(state, pair.first), body_of(state, pair.second)) > 1;
  });
  return deep ? "two particles overlap too deeply" : "";
}

}  // namespace clca::testing
