#include "contact/rule/surfaces.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "contact/rule/numbers.hpp"

namespace clca::contact {

namespace {

using lattice::Axial;

/// How far from touched sites the shape of a surface counts. With 2, a grain in a corner of 120
/// degrees would see too little of its sides.
constexpr int kNear = 3;

/// Bodies near a grain that form one surface, as far as is known.
struct Surface {
  std::vector<Obstacle> obstacles;  // those of them that are touched
  bool has_side = false;            // of the box
  std::vector<Axial> near;          // their sites near touched ones; see outline()
  Axial outwards;                   // sum of directions from sites beside touched ones to free ones
};

/// The lowest and the highest site of each column, sorted: it has the convex hull of all.
std::vector<Axial> outline(std::vector<Axial> sites) {
  std::sort(sites.begin(), sites.end());
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

/// Whether a direction leads from an obstacle to the side on which the grain is.
bool faces(const Obstacle& obstacle, lattice::Direction direction) {
  return std::any_of(lattice::kDirections.begin(), lattice::kDirections.end(),
                     [&](lattice::Direction blocked) {
                       return (obstacle.directions >> index_of(blocked) & 1U) != 0 &&
                              turns_between(direction, blocked) > 1;
                     });
}

/// The sites at most this far from those that are touched, sorted.
std::vector<Axial> around(const std::vector<Obstacle>& obstacles, int distance) {
  std::vector<Axial> result;
  for (const Obstacle& obstacle : obstacles) {
    for (const Axial touched : obstacle.sites) {
      for (int x = -distance; x <= distance; ++x) {
        for (int q = std::max(-distance, -distance - x); q <= std::min(distance, distance - x);
             ++q) {
          result.push_back(touched + Axial{x, q});
        }
      }
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Each wall and side near the touched sites.
std::vector<Surface> bodies_near(const grains::Box& box, lattice::Site reference,
                                 const std::vector<Obstacle>& obstacles) {
  std::map<grains::Owner, Surface> by_body;
  const auto is_free = [&](Axial site) {
    const grains::Owner owner = body_at(box, reference + site);
    return owner == grains::kFree || grains::is_particle(owner);
  };
  for (const Axial site : around(obstacles, kNear)) {
    if (!is_free(site)) {
      by_body[body_at(box, reference + site)].near.push_back(site);
    }
  }
  for (const Obstacle& obstacle : obstacles) {
    by_body[obstacle.body].obstacles = {obstacle};
    for (const Axial site : around({obstacle}, 2)) {
      for (const lattice::Direction direction : lattice::kDirections) {
        // Not to the far side of a thin wall.
        if (!is_free(site) && is_free(site + unit(direction)) && faces(obstacle, direction)) {
          Surface& body = by_body[body_at(box, reference + site)];
          body.outwards = body.outwards + unit(direction);
        }
      }
    }
  }
  std::vector<Surface> result;
  for (auto& [owner, body] : by_body) {
    body.has_side = is_side(owner);
    body.near = outline(std::move(body.near));
    result.push_back(std::move(body));
  }
  return result;
}

Surface joined(const Surface& one, const Surface& other) {
  Surface result = one;
  result.obstacles.insert(result.obstacles.end(), other.obstacles.begin(), other.obstacles.end());
  result.has_side = one.has_side || other.has_side;
  result.near.insert(result.near.end(), other.near.begin(), other.near.end());
  result.near = outline(std::move(result.near));
  result.outwards = result.outwards + other.outwards;
  return result;
}

/// Whether and how much two may be one surface: walls before sides of the box, which are whole;
/// then the cosine of the angle between their ways outwards, in 2^-60.
std::pair<bool, std::int64_t> likeness(const Surface& one, const Surface& other) {
  const auto direction = [](Axial outwards) {
    return outwards == Axial() ? UnitVector() : unit_vector(outwards);
  };
  return {!one.has_side && !other.has_side,
          cosine(direction(one.outwards), direction(other.outwards))};
}

/// Joins the two that are most alike of those that form one surface. Returns false if there are
/// none.
bool join_two(std::vector<Surface>& all, const std::vector<Axial>& grain) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (!all[i].has_side || !all[j].has_side) {
        pairs.emplace_back(i, j);
      }
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& one, const auto& other) {
    return likeness(all[one.first], all[one.second]) >
           likeness(all[other.first], all[other.second]);
  });
  for (const auto& [i, j] : pairs) {
    if (Surface both = joined(all[i], all[j]); separable(grain, both.near)) {
      all[i] = std::move(both);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

}  // namespace

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

std::vector<std::vector<Obstacle>> surfaces(const grains::Box& box, const grains::Particle& grain,
                                            const std::vector<Obstacle>& obstacles) {
  std::vector<std::vector<Obstacle>> result;
  if (obstacles.size() < 2) {
    for (const Obstacle& obstacle : obstacles) {
      result.push_back({obstacle});
    }
    return result;
  }
  std::vector<Surface> all = bodies_near(box, grain.site(), obstacles);
  const std::vector<Axial> of_grain = outline(box.state.shape(grain).sites());
  while (join_two(all, of_grain)) {
  }
  for (Surface& surface : all) {
    if (!surface.obstacles.empty()) {
      result.push_back(std::move(surface.obstacles));
    }
  }
  return result;
}

// All vectors from one to the other have to lie within less than half a turn: from `first`
// anticlockwise to `last`.
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

}  // namespace clca::contact
