#include "clca/render/body.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <set>
#include <utility>

namespace clca::render {

namespace {

using lattice::Axial;

/// Half of the cell of the half-spacing lattice whose lower left corner is `cell`.
struct SmallTriangle {
  Axial cell;
  bool upper = false;

  // NOLINTNEXTLINE(readability-implicit-bool-conversion): clang-tidy 14 compares a bool with 0 here
  auto operator<=>(const SmallTriangle&) const = default;

  /// Anticlockwise.
  std::array<Axial, 3> corners() const {
    const Axial right = cell + Axial{1, 0};
    const Axial above = cell + Axial{0, 1};
    return upper ? std::array{cell + Axial{1, 1}, above, right} : std::array{cell, right, above};
  }
};

void add_around(Axial point, std::vector<SmallTriangle>& triangles) {
  const auto [x, q] = point;
  triangles.insert(triangles.end(), {{{x, q}, false},
                                     {{x - 1, q}, false},
                                     {{x, q - 1}, false},
                                     {{x - 1, q - 1}, true},
                                     {{x, q - 1}, true},
                                     {{x - 1, q}, true}});
}

std::vector<SmallTriangle> small_triangles(std::span<const Axial> sites) {
  std::vector<SmallTriangle> triangles;
  for (const Axial site : sites) {
    const Axial point = site + site;
    add_around(point, triangles);
    for (const lattice::Direction direction :
         {lattice::Direction::up, lattice::Direction::up_right, lattice::Direction::down_right}) {
      const Axial step = lattice::unit(direction);
      if (std::binary_search(sites.begin(), sites.end(), site + step)) {
        add_around(point + step, triangles);
      }
    }
  }
  std::ranges::sort(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// The contiguous triangles from `first` to `last`, one above the other.
Trapezoid column_piece(const SmallTriangle& first, const SmallTriangle& last) {
  constexpr Axial kRight = {1, 0};
  constexpr Axial kAbove = {0, 1};
  return {.left_low = first.upper ? first.cell + kAbove : first.cell,
          .left_high = last.cell + kAbove,
          .right_low = first.cell + kRight,
          .right_high = last.upper ? last.cell + kRight + kAbove : last.cell + kRight};
}

/// Whether `a`, `b`, `c` are collinear in this order.
bool is_straight(Axial a, Axial b, Axial c) {
  return (b.q - a.q) * (c.x - b.x) == (c.q - b.q) * (b.x - a.x);
}

bool can_extend(const Trapezoid& left, const Trapezoid& right) {
  return left.right_low == right.left_low && left.right_high == right.left_high &&
         is_straight(left.left_low, left.right_low, right.right_low) &&
         is_straight(left.left_high, left.right_high, right.right_high);
}

}  // namespace

Outline outline(const lattice::Shape& shape) {
  std::set<std::pair<Axial, Axial>> edges;
  for (const SmallTriangle& triangle : small_triangles(shape.sites())) {
    const auto corners = triangle.corners();
    for (std::size_t i = 0; i < 3; ++i) {
      edges.emplace(corners[i], corners[(i + 1) % 3]);
    }
  }
  std::map<Axial, Axial> next;  // along the edges that belong to one triangle only
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) {
      next.emplace(from, to);
    }
  }
  Outline corners;
  Axial before = next.begin()->first;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const Axial here = next.at(before);
    if (here - before != next.at(here) - here) {
      corners.push_back(here);
    }
    before = here;
  }
  return corners;
}

std::vector<Trapezoid> trapezoids(const lattice::Shape& shape) {
  const std::vector<SmallTriangle> triangles = small_triangles(shape.sites());  // up the columns
  const auto follows = [](const SmallTriangle& lower, const SmallTriangle& upper) {
    return lower.upper ? upper == SmallTriangle{lower.cell + Axial{0, 1}, false}
                       : upper == SmallTriangle{lower.cell, true};
  };
  std::vector<Trapezoid> result;
  std::map<std::pair<Axial, Axial>, std::size_t> by_right_side;
  std::size_t first = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i + 1 < triangles.size() && follows(triangles[i], triangles[i + 1])) {
      continue;
    }
    const Trapezoid piece = column_piece(triangles[first], triangles[i]);
    const auto left = by_right_side.find({piece.left_low, piece.left_high});
    std::size_t number = result.size();
    if (left != by_right_side.end() && can_extend(result[left->second], piece)) {
      number = left->second;
      result[number].right_low = piece.right_low;
      result[number].right_high = piece.right_high;
    } else {
      result.push_back(piece);
    }
    by_right_side[{piece.right_low, piece.right_high}] = number;
    first = i + 1;
  }
  return result;
}

}  // namespace clca::render
