// Points and rectangles in the box.

#include "scene/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clca/scene/walls.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

std::string shown(const lattice::Rectangle& edges) {
  return fmt::format("[{}, {}, {}, {}]", edges.left, edges.bottom, edges.right, edges.top);
}

Eigen::Vector2d read_point(const Value& value, const std::string& path) {
  const std::vector<Value>& items = read_list(value, path, 2, 2);
  return {read_number(items[0], path, -kMaxCoordinate, kMaxCoordinate),
          read_number(items[1], path, -kMaxCoordinate, kMaxCoordinate)};
}

lattice::Rectangle read_rectangle(const Value& value, const std::string& path) {
  const std::vector<Value>& items = read_list(value, path, 4, 4);
  std::array<double, 4> edges = {};
  std::transform(items.begin(), items.end(), edges.begin(), [&](const Value& item) {
    return read_number(item, path, -kMaxCoordinate, kMaxCoordinate);
  });
  const auto [left, bottom, right, top] = edges;
  if (left >= right || bottom >= top) {
    fail(value.location,
         fmt::format("{}: expected [left, bottom, right, top] with left < right and "
                     "bottom < top, found [{}, {}, {}, {}]",
                     path, left, bottom, right, top));
  }
  return {left, bottom, right, top};
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle) {
  // Columns of one parity are alike, so the first inside of each decides.
  const auto bounded = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int column = bounded(rectangle.left / lattice::kColumnPitch - 1, lattice.columns());
  const int row = bounded(rectangle.bottom - 1, lattice.rows());
  for (int i = column; i < std::min(column + 5, lattice.columns()); ++i) {
    for (int j = row; j < std::min(row + 4, lattice.rows()); ++j) {
      if (rectangle.contains(lattice::position(lattice::Site{i, j}))) {
        return false;
      }
    }
  }
  return true;
}

void require_site(const lattice::Rectangle& region, const Value& value, const std::string& path,
                  const Box& box) {
  if (holds_no_site(lattice_of(box), region)) {
    fail(value.location, fmt::format("{}: no site of the box, {} wide and {} high, lies in {}",
                                     path, box.width, box.height, shown(region)));
  }
}

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
