#include "scene/swept_sites.hpp"

#include <algorithm>
#include <tuple>

#include "clca/scene/walls.hpp"

namespace clca::scene {

namespace {

using lattice::Direction;

/// A site by the line along the motion and the position on that line.
struct LinePosition {
  int line = 0;
  int position = 0;
};

/// Positions on a line from `first` to `last`; none if first > last.
struct LineInterval {
  int first = 0;
  int last = -1;
};

/// The direction or its opposite, whichever goes up or to the right.
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

LinePosition line_position_of(Direction direction, lattice::Site site) {
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

lattice::Site site_of(Direction direction, LinePosition spot) {
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

/// The part of a line inside the box; in a periodic box without lateral bounds.
LineInterval inside(const lattice::Lattice& lattice, Direction direction, int line) {
  if (direction == Direction::up) {
    const int floor = -(line >> 1);  // of a site in row 0
    return {floor, floor + lattice.rows() - 1};
  }
  // Along a sloping line the row changes every second column.
  LineInterval rows = {-2 * line, 2 * (lattice.rows() - line) - 1};
  if (direction == Direction::down_right) {
    rows = {2 * (line - lattice.rows()) + 1, 2 * line};
  }
  if (lattice.periodic()) {
    return rows;
  }
  return {std::max(rows.first, 0), std::min(rows.last, lattice.columns() - 1)};
}

/// Range of offsets along the forward direction.
grains::OffsetRange forward_range_of(const grains::WallMotion& motion) {
  const grains::OffsetRange range = grains::range_of(motion);
  return forward(motion.direction) == motion.direction
             ? range
             : grains::OffsetRange{-range.high, -range.low};
}

using Test = std::function<bool(lattice::Site)>;

bool any_swept_site(const lattice::Lattice& lattice, Direction direction, int line,
                    LineInterval interval, const Test& test) {
  for (int position = interval.first; position <= interval.last; ++position) {
    const lattice::Site site = site_of(direction, {line, position});
    if (test({lattice.wrapped(site.column), site.row})) {
      return true;
    }
  }
  return false;
}

void sort_along(Direction direction, std::vector<lattice::Site>& sites) {
  const auto order = [direction](lattice::Site site) {
    const LinePosition spot = line_position_of(direction, site);
    return std::tuple(spot.line, spot.position);
  };
  std::sort(sites.begin(), sites.end(),
            [&](lattice::Site a, lattice::Site b) { return order(a) < order(b); });
}

}  // namespace

bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall, const Test& test) {
  std::vector<lattice::Site> sites = wall_sites(lattice, wall);
  if (!wall.motion) {
    return std::any_of(sites.begin(), sites.end(), test);
  }
  const Direction direction = forward(wall.motion->direction);
  const grains::OffsetRange range = forward_range_of(*wall.motion);
  sort_along(direction, sites);
  LinePosition before = {};
  int done = 0;  // the last position on the line of `before` that has been visited
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const LinePosition home = line_position_of(direction, sites[i]);
    const LineInterval box = inside(lattice, direction, home.line);
    const bool same_line = i > 0 && home.line == before.line;
    const int from = std::max(home.position + range.low, box.first);
    const LineInterval fresh = {same_line ? std::max(from, done + 1) : from,
                                std::min(home.position + range.high, box.last)};
    if (any_swept_site(lattice, direction, home.line, fresh, test)) {
      return true;
    }
    done = fresh.last;
    before = home;
  }
  return false;
}

}  // namespace clca::scene
