#include "scene/sweep.hpp"

#include <algorithm>
#include <tuple>

#include "clca/scene/walls.hpp"

namespace clca::scene {

namespace {

using lattice::Direction;

/// A site by the line along the motion that it lies on, and by its place there.
struct Spot {
  int line = 0;
  int position = 0;
};

/// Places on a line from `first` to `last`; none where first > last.
struct Stretch {
  int first = 0;
  int last = -1;
};

/// Of a direction and its opposite the one that goes up or to the right.
Direction forward(Direction direction) {
  switch (direction) {
    case Direction::down:
    case Direction::down_left:
    case Direction::up_left:
      return lattice::opposite(direction);
    default:
      return direction;
  }
}

Spot spot_of(Direction direction, lattice::Site site) {
  const lattice::Axial at = site - lattice::Site{};
  switch (direction) {
    case Direction::up:
      return {at.x, at.q};
    case Direction::up_right:
      return {at.q, at.x};
    default:
      return {at.x + at.q, at.x};
  }
}

lattice::Site site_of(Direction direction, Spot spot) {
  const auto at = [&]() -> lattice::Axial {
    switch (direction) {
      case Direction::up:
        return {spot.line, spot.position};
      case Direction::up_right:
        return {spot.position, spot.line};
      default:
        return {spot.position, spot.line - spot.position};
    }
  }();
  return lattice::Site{} + at;
}

/// The part of a line that lies in the box, without end to the sides where it is periodic.
Stretch inside(const lattice::Lattice& lattice, Direction direction, int line) {
  if (direction == Direction::up) {
    const int floor = -(line >> 1);  // of a site in row 0
    return {floor, floor + lattice.rows() - 1};
  }
  // Along a sloping line the row changes with every second column.
  Stretch rows = {-2 * line, 2 * (lattice.rows() - line) - 1};
  if (direction == Direction::down_right) {
    rows = {2 * (line - lattice.rows()) + 1, 2 * line};
  }
  if (lattice.periodic()) {
    return rows;
  }
  return {std::max(rows.first, 0), std::min(rows.last, lattice.columns() - 1)};
}

/// Where the wall comes to from home, forwards.
grains::Range forward_range(const grains::Motion& motion) {
  const grains::Range range = grains::range_of(motion);
  return forward(motion.direction) == motion.direction ? range
                                                       : grains::Range{-range.high, -range.low};
}

using Test = std::function<bool(lattice::Site)>;

bool meets(const lattice::Lattice& lattice, Direction direction, int line, Stretch stretch,
           const Test& test) {
  for (int position = stretch.first; position <= stretch.last; ++position) {
    const lattice::Site site = site_of(direction, {line, position});
    if (test({lattice.wrapped(site.column), site.row})) {
      return true;
    }
  }
  return false;
}

void sort_along(Direction direction, std::vector<lattice::Site>& sites) {
  const auto order = [direction](lattice::Site site) {
    const Spot spot = spot_of(direction, site);
    return std::tuple(spot.line, spot.position);
  };
  std::sort(sites.begin(), sites.end(),
            [&](lattice::Site a, lattice::Site b) { return order(a) < order(b); });
}

}  // namespace

bool meets(const lattice::Lattice& lattice, const Wall& wall, const Test& test) {
  std::vector<lattice::Site> sites = wall_sites(lattice, wall);
  if (!wall.motion) {
    return std::any_of(sites.begin(), sites.end(), test);
  }
  const Direction direction = forward(wall.motion->direction);
  const grains::Range range = forward_range(*wall.motion);
  sort_along(direction, sites);
  Spot before = {};
  int done = 0;  // the last place on the line of `before` that has been visited
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Spot home = spot_of(direction, sites[i]);
    const Stretch box = inside(lattice, direction, home.line);
    const bool same_line = i > 0 && home.line == before.line;
    const int from = std::max(home.position + range.low, box.first);
    const Stretch fresh = {same_line ? std::max(from, done + 1) : from,
                           std::min(home.position + range.high, box.last)};
    if (meets(lattice, direction, home.line, fresh, test)) {
      return true;
    }
    done = fresh.last;
    before = home;
  }
  return false;
}

}  // namespace clca::scene
