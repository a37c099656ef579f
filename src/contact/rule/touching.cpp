#include "contact/rule/touching.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "contact/rule/numbers.hpp"

namespace clca::contact {

using lattice::Axial;

std::int64_t order_key(const grains::State& state, lattice::Direction down, std::uint32_t id) {
  constexpr std::int64_t kColumns = std::int64_t{1} << 31;
  const grains::Particle& grain = state.particles[id];
  const lattice::Site site = {state.lattice.wrapped(grain.column), grain.row};
  const Axial step = unit(down);
  const int depth =  // four times the coordinate along `down`
      3 * step.x * site.column + (2 * step.q + step.x) * lattice::doubled_height(site);
  return depth * kColumns + site.column;
}

std::optional<UnitVector> normal_between(const lattice::Shape& first, const lattice::Shape& second,
                                         Axial to_second) {
  Axial blocked;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::vector<Axial> lead = first.lead_sites(direction);
    if (std::ranges::any_of(lead, [&](Axial site) { return second.contains(site - to_second); })) {
      blocked = blocked + unit(direction);
    }
  }
  if (blocked == Axial()) {
    return std::nullopt;
  }
  const bool round = first.is_round() && second.is_round();
  return unit_vector(Axial() - (round ? to_second : blocked));
}

NormalTable::PairTable::PairTable(const lattice::Shape& first, const lattice::Shape& second) {
  const auto extent = [](const lattice::Shape& shape) {
    const auto [lowest, highest] = std::ranges::minmax(shape.sites(), {}, &Axial::q);
    return std::pair(Axial{shape.sites().front().x, lowest.q},  // sorted by x
                     Axial{shape.sites().back().x, highest.q});
  };
  const auto [first_low, first_high] = extent(first);
  const auto [second_low, second_high] = extent(second);
  constexpr Axial kNext = {1, 1};
  low = first_low - second_high - kNext;
  size = first_high - second_low + kNext - low + kNext;
  normals.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.q), kUnknown);
}

namespace {

/// How far from touched sites, in steps, the shape of a surface counts. With 2, a grain in a corner
/// of 120 degrees would see too little of its sides.
constexpr int kNear = 3;

/// Walls and sides of the box near a grain that form one surface, however it is cut into bodies; as
/// far as is known, so each by itself at first.
struct Surface {
  /// Bodies that touch the grain, and their sites next to it: from its reference site,
  /// one for each direction in which they block it.
  std::map<grains::Owner, std::vector<Axial>> touched = {};
  unsigned directions = 0;       ///< that these block, as bits
  bool has_side = false;         ///< of the box
  std::vector<Axial> near = {};  ///< their sites near touched ones; see outline()
  Axial outwards = {};           ///< sum of directions from sites beside touched ones to free ones
};

bool contains(unsigned directions, lattice::Direction direction) {
  return (directions >> lattice::index_of(direction) & 1U) != 0;
}

/// The wall, side or grain at a site; kFree if none. Sites beyond the border belong to sides.
grains::Owner body_at(const grains::Box& box, lattice::Site site) {
  const lattice::Lattice& lattice = box.state.lattice;
  if (site.row < 0) {
    return kFloor;
  }
  if (site.row >= lattice.rows()) {
    return kCeiling;
  }
  if (!lattice.contains(site)) {
    return site.column < 0 ? kLeftSide : kRightSide;
  }
  return box.occupancy.owner(lattice.index(site));
}

/// A surface for each wall or side that blocks the grain.
std::map<grains::Owner, Surface> touched_surfaces(const grains::Box& box,
                                                  const grains::Particle& grain) {
  std::map<grains::Owner, Surface> result;
  for (const lattice::Direction direction : lattice::kDirections) {
    box.for_each_entered(grain, direction, [&](std::size_t index) {
      const grains::Owner owner = box.occupancy.owner(index);
      if (owner == grains::kFree || grains::is_particle(owner)) {
        return;
      }
      const lattice::Site site = box.state.lattice.site(index);
      const grains::Owner body = body_at(box, site);
      result[body].directions |= 1U << lattice::index_of(direction);
      result[body].touched[body].push_back(box.state.lattice.shortest_vector(grain.site(), site));
    });
  }
  return result;
}

/// The lowest and the highest site of each column, sorted: it has the convex hull of all.
std::vector<Axial> outline(std::vector<Axial> sites) {
  std::ranges::sort(sites);
  std::vector<Axial> result;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const bool first = i == 0 || sites[i - 1].x != sites[i].x;
    const bool last = i + 1 == sites.size() || sites[i + 1].x != sites[i].x;
    if (first || last) {
      result.push_back(sites[i]);
    }
  }
  return result;
}

/// The sites at most this many steps from one of `sites`, sorted.
std::vector<Axial> sites_around(const std::vector<Axial>& sites, int distance) {
  std::vector<Axial> result;
  for (const Axial site : sites) {
    for (int x = -distance; x <= distance; ++x) {
      for (int q = std::max(-distance, -distance - x); q <= std::min(distance, distance - x); ++q) {
        result.push_back(site + Axial{x, q});
      }
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Whether a direction leads to the side on which the grain is, not to the far side of a thin wall.
bool faces_grain(const Surface& body, lattice::Direction direction) {
  return std::ranges::any_of(lattice::kDirections, [&](lattice::Direction blocked) {
    return contains(body.directions, blocked) && sixths_between(direction, blocked) > 1;
  });
}

/// Adds the bodies near those that touch the grain, and sets Surface::near and outwards of all.
void add_near_bodies(const grains::Box& box, lattice::Site reference,
                     std::map<grains::Owner, Surface>& bodies) {
  const auto is_free = [&](Axial site) {
    const grains::Owner owner = body_at(box, reference + site);
    return owner == grains::kFree || grains::is_particle(owner);
  };
  std::vector<Axial> touched;
  for (const auto& [owner, body] : bodies) {
    for (const auto& [same, sites] : body.touched) {
      touched.insert(touched.end(), sites.begin(), sites.end());
      for (const Axial site : sites_around(sites, 2)) {
        for (const lattice::Direction direction : lattice::kDirections) {
          if (!is_free(site) && is_free(site + unit(direction)) && faces_grain(body, direction)) {
            Axial& outwards = bodies[body_at(box, reference + site)].outwards;
            outwards = outwards + unit(direction);
          }
        }
      }
    }
  }
  for (const Axial site : sites_around(touched, kNear)) {
    if (!is_free(site)) {
      bodies[body_at(box, reference + site)].near.push_back(site);
    }
  }
  for (auto& [owner, body] : bodies) {
    body.has_side = is_side(owner);
    body.near = outline(std::move(body.near));
  }
}

Surface merged(const Surface& one, const Surface& other) {
  Surface result = one;
  result.touched.insert(other.touched.begin(), other.touched.end());
  result.directions |= other.directions;
  result.has_side = one.has_side || other.has_side;
  result.near.insert(result.near.end(), other.near.begin(), other.near.end());
  result.near = outline(std::move(result.near));
  result.outwards = result.outwards + other.outwards;
  return result;
}

/// Merge priority of two surfaces: walls before sides of the box, which are whole; then the cosine
/// of the angle between their ways outwards, in 2^-60.
std::pair<bool, std::int64_t> likeness(const Surface& one, const Surface& other) {
  const auto direction = [](Axial outwards) {
    return outwards == Axial() ? UnitVector() : unit_vector(outwards);
  };
  return {!one.has_side && !other.has_side,
          cosine(direction(one.outwards), direction(other.outwards))};
}

/// Whether a straight line has all of `one` on one side and all of `other` on the other: all
/// vectors from one to the other have to lie within less than half a turn, from `first`
/// anticlockwise to `last`.
bool separable(const std::vector<Axial>& one, const std::vector<Axial>& other) {
  const auto cross = [](Axial a, Axial b) {
    return std::int64_t{a.x} * b.q - std::int64_t{a.q} * b.x;
  };
  Axial first = other.front() - one.front();
  Axial last = first;
  for (const Axial from : one) {
    for (const Axial to : other) {
      const Axial vector = to - from;
      const std::int64_t past_first = cross(first, vector);
      const std::int64_t past_last = cross(last, vector);
      if (past_first > 0 && past_last > 0) {
        last = vector;
      } else if (past_first < 0 && past_last < 0) {
        first = vector;
      } else if (past_first < 0 || past_last > 0 ||
                 (past_first == 0 && past_last == 0 &&
                  std::int64_t{first.x} * vector.x + std::int64_t{first.q} * vector.q <= 0)) {
        return false;
      }
    }
  }
  return true;
}

/// Merges the most alike pair that forms one surface: a straight line separates it, where it is
/// near, from the grain. Two sides of the box never form one. Returns whether there was a pair.
bool merge_most_alike(std::vector<Surface>& all, const std::vector<Axial>& grain) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (!all[i].has_side || !all[j].has_side) {
        pairs.emplace_back(i, j);
      }
    }
  }
  std::ranges::stable_sort(pairs, std::ranges::greater(), [&](const auto& pair) {
    return likeness(all[pair.first], all[pair.second]);
  });
  for (const auto& [i, j] : pairs) {
    if (Surface both = merged(all[i], all[j]); separable(grain, both.near)) {
      all[i] = std::move(both);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

/// The bodies of a surface that get contacts of their own: of those with one velocity a wall before
/// a side, with most touched sites, with the lowest code.
std::vector<grains::Owner> bodies_of_contacts(const Surface& surface, const WallVelocities& walls) {
  const auto velocity = [&](grains::Owner body) {
    return is_side(body) ? Velocity<>() : walls[grains::wall_number(body)];
  };
  const auto rank = [&](grains::Owner body) {
    return std::tuple(!is_side(body), surface.touched.at(body).size(), -std::int64_t{body});
  };
  std::vector<grains::Owner> chosen;
  for (const auto& [body, sites] : surface.touched) {
    const auto alike = std::ranges::find_if(
        chosen, [&, now = velocity(body)](grains::Owner other) { return velocity(other) == now; });
    if (alike == chosen.end()) {
      chosen.push_back(body);
    } else if (rank(body) > rank(*alike)) {
      *alike = body;
    }
  }
  return chosen;
}

}  // namespace

std::size_t add_wall_contacts(const grains::Box& box, std::uint32_t id, const WallVelocities& walls,
                              std::vector<StepContact>& touches) {
  const grains::Particle& grain = box.state.particles[id];
  std::map<grains::Owner, Surface> bodies = touched_surfaces(box, grain);
  const std::size_t count = bodies.size();
  if (count > 1) {
    add_near_bodies(box, grain.site(), bodies);
  }
  std::vector<Surface> surfaces;
  for (auto& [owner, body] : bodies) {
    surfaces.push_back(std::move(body));
  }
  if (count > 1) {
    const std::vector<Axial> of_grain = outline(box.state.shape(grain).sites());
    while (merge_most_alike(surfaces, of_grain)) {
    }
  }
  const auto first = static_cast<std::ptrdiff_t>(touches.size());
  for (const Surface& surface : surfaces) {
    Axial blocked;
    for (const lattice::Direction direction : lattice::kDirections) {
      blocked = contains(surface.directions, direction) ? blocked + unit(direction) : blocked;
    }
    if (blocked == Axial()) {
      continue;
    }
    for (const grains::Owner body : bodies_of_contacts(surface, walls)) {
      touches.push_back(
          {.contact = {.upper = id, .other = body, .normal = unit_vector(Axial() - blocked)}});
    }
  }
  std::ranges::sort(touches.begin() + first, touches.end(), {},
                    [](const StepContact& touch) { return touch.contact.other; });
  return count;
}

std::vector<StepContact> all_contacts(const grains::Box& box, lattice::Direction down,
                                      NormalTable& normals, const WallVelocities& walls) {
  const grains::State& state = box.state;
  std::vector<StepContact> result;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (!grain.present) {
      continue;
    }
    add_wall_contacts(box, id, walls, result);
    std::set<grains::Owner> others;
    box.for_each_index(grain, box.footprints.footprint(grain).neighbours,
                       [&](std::size_t index) { others.insert(box.occupancy.owner(index)); });
    for (const grains::Owner owner : others) {
      if (!grains::is_particle(owner) || is_above(state, down, grains::particle_id(owner), id)) {
        continue;
      }
      const grains::Particle& below = state.particles[grains::particle_id(owner)];
      const Axial to_other = state.lattice.shortest_vector(grain.site(), below.site());
      const UnitVector normal = normals.normal(grain.kind, below.kind, to_other);
      if (normal != UnitVector()) {
        result.push_back(
            {.contact = {.upper = id, .other = owner, .normal = normal}, .to_other = to_other});
      }
    }
  }
  return result;
}

std::vector<const StepContact*> successors(std::span<const Contact> before,
                                           std::span<const StepContact> now) {
  // Cosine of 45 degrees, see cosine(). Normals of a straight wall differ by up to 30 degrees.
  constexpr std::int64_t kLeastCosine = std::int64_t{759'250'125} << kUnitBits;
  // The best first. Whether the body is the same counts last: a surface may have several.
  using Match = std::tuple<bool, std::int64_t, bool, grains::Owner, grains::Owner, std::size_t,
                           const StepContact*>;
  std::vector<Match> matches;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (const StepContact& touch : now) {
      const grains::Owner was = before[i].other;
      const grains::Owner is = touch.contact.other;
      const std::int64_t like = cosine(before[i].normal, touch.contact.normal);
      if (before[i].upper == touch.contact.upper && like > kLeastCosine) {
        matches.emplace_back(is_side(was) == is_side(is), like, was == is, was, is, i, &touch);
      }
    }
  }
  std::ranges::sort(matches, std::greater());
  std::vector<const StepContact*> result(before.size(), nullptr);
  for (const auto& [same_kind, like, same_body, was, is, i, touch] : matches) {
    if (result[i] == nullptr && std::ranges::find(result, touch) == result.end()) {
      result[i] = touch;
    }
  }
  return result;
}

std::vector<StepContact> next_contacts(const grains::State& state,
                                       const std::vector<Contact>& before,
                                       const std::vector<StepContact>& now, lattice::Direction down,
                                       bool sorted) {
  const auto bodies = [](const Contact& contact) {
    return sorted_bodies(contact.upper, contact.other);
  };
  std::map<std::pair<grains::Owner, grains::Owner>, StepContact>
      left;  // that no earlier one goes on as
  std::vector<StepContact> at_walls;
  for (const StepContact& touch : now) {
    left.emplace(bodies(touch.contact), touch);
    if (!grains::is_particle(touch.contact.other)) {
      at_walls.push_back(touch);
    }
  }
  std::vector<Contact> were_at_walls;
  std::ranges::copy_if(before, std::back_inserter(were_at_walls),
                       [](const Contact& contact) { return !grains::is_particle(contact.other); });
  const std::vector<const StepContact*> next = successors(were_at_walls, at_walls);
  auto next_at_wall = next.begin();
  std::vector<StepContact> all;
  for (const Contact& contact : before) {
    const StepContact* at_wall = grains::is_particle(contact.other) ? nullptr : *next_at_wall++;
    const auto found = left.find(bodies(at_wall == nullptr ? contact : at_wall->contact));
    if (found == left.end() || (at_wall == nullptr && !grains::is_particle(contact.other))) {
      continue;
    }
    StepContact& kept = all.emplace_back(found->second);
    kept.contact.impulse = kept.contact.upper == contact.upper
                               ? contact.impulse
                               : with_bodies_swapped(contact.impulse);
    left.erase(found);
  }
  const auto first_new = static_cast<std::ptrdiff_t>(all.size());
  for (const auto& [pair, touch] : left) {
    all.push_back(touch);
  }
  std::sort(all.begin() + (sorted ? 0 : first_new), all.end(),
            [&](const StepContact& one, const StepContact& other) {
              return one.key(state, down) < other.key(state, down);
            });
  return all;
}

}  // namespace clca::contact
