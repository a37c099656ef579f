// Fast ways to shapes and walls against slow and plain ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>

#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::lattice::reference_test {
namespace {

using Sites = std::set<Axial>;

/// The sites that steps within `sites` reach from `first`.
Sites flooded(const Sites& sites, Axial first) {
  Sites wet = {first};
  std::vector<Axial> open = {first};
  while (!open.empty()) {
    const Axial site = open.back();
    open.pop_back();
    for (const Direction direction : kDirections) {
      const Axial next = site + unit(direction);
      if (sites.contains(next) && wet.insert(next).second) {
        open.push_back(next);
      }
    }
  }
  return wet;
}

bool is_shape(const Sites& sites, int reach) {
  Sites outside;
  for (int x = -reach - 1; x <= reach + 1; ++x) {
    for (int q = -reach - 1; q <= reach + 1; ++q) {
      if (!sites.contains({x, q})) {
        outside.insert({x, q});
      }
    }
  }
  return flooded(sites, *sites.begin()) == sites && flooded(outside, *outside.begin()) == outside;
}

bool accepted(const Sites& sites) {
  try {
    const Shape shape({sites.begin(), sites.end()});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

TEST(Reference, ShapesAreThoseWithoutGapsAndHoles) {
  std::mt19937 bits(1);
  int shapes = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const int reach = 1 + trial % 4;
    const auto side = static_cast<unsigned>(2 * reach + 1);
    const auto coordinate = [&] { return static_cast<int>(bits() % side) - reach; };
    // Grown from one site, so that many connect; a site may go again, which opens holes.
    Sites sites = {{0, 0}};
    for (unsigned i = 0; i < side * side; ++i) {
      const Axial site = {coordinate(), coordinate()};
      const bool touches = std::any_of(kDirections.begin(), kDirections.end(), [&](auto direction) {
        return sites.contains(site + unit(direction));
      });
      if (touches) {
        sites.insert(site);
      }
    }
    if (trial % 3 == 0 && sites.size() > 1) {
      sites.erase({coordinate(), coordinate()});
    }
    EXPECT_EQ(accepted(sites), is_shape(sites, reach)) << "trial " << trial;
    shapes += accepted(sites) ? 1 : 0;
  }
  EXPECT_GT(shapes, 400);
  EXPECT_LT(shapes, 3600);
}

TEST(Reference, AThinShapeThatSpansFarTakesNoLongerThanItsSites) {
  std::vector<Axial> sites;
  for (int i = -20000; i < 20000; ++i) {
    sites.push_back({i, i});
    sites.push_back({i, i + 1});
  }
  EXPECT_EQ(Shape(sites).size(), 80000U);
}

long long cross(Axial a, Axial b, Axial c) {
  return static_cast<long long>((b - a).x) * (c - a).q -
         static_cast<long long>((b - a).q) * (c - a).x;
}

bool on_or_inside(const std::vector<Axial>& corners, Axial site) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Axial from = corners[i];
    const Axial to = corners[(i + 1) % corners.size()];
    const auto [left, right] = std::minmax({from.x, to.x});
    const auto [low, high] = std::minmax({from.q, to.q});
    if (cross(from, to, site) == 0 && left <= site.x && site.x <= right && low <= site.q &&
        site.q <= high) {
      return true;
    }
    if ((from.q > site.q) != (to.q > site.q)) {
      inside = inside != ((cross(from, to, site) > 0) == (to.q > from.q));
    }
  }
  return inside;
}

TEST(Reference, PolygonsHoldTheSitesOnAndInsideTheirOutline) {
  constexpr int kReach = 9;
  std::mt19937 bits(2);
  int polygons = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Axial> corners;
    for (int i = 0; i < 3 + trial % 5; ++i) {
      corners.push_back({static_cast<int>(bits() % (2 * kReach + 1)) - kReach,
                         static_cast<int>(bits() % (2 * kReach + 1)) - kReach});
    }
    Sites expected;
    for (int x = -kReach; x <= kReach; ++x) {
      for (int q = -kReach; q <= kReach; ++q) {
        if (on_or_inside(corners, {x, q})) {
          expected.insert({x, q});
        }
      }
    }
    if (!accepted(expected)) {
      EXPECT_THROW(Shape::polygon(corners), std::invalid_argument);
      continue;
    }
    const Shape shape = Shape::polygon(corners);
    EXPECT_EQ(Sites(shape.sites().begin(), shape.sites().end()), expected) << "trial " << trial;
    ++polygons;
  }
  EXPECT_GT(polygons, 200);
}

double distance(const Segment& segment, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double share = std::clamp((point - segment.from).dot(along) / along.squaredNorm(), 0., 1.);
  return (point - segment.from - share * along).norm();
}

/// The sites near the segment, and all points nearest to the way between its ends.
std::set<Site> plain_wall(const Lattice& lattice, const Segment& segment) {
  std::set<Site> sites;
  for (int column = 0; column < lattice.columns(); ++column) {
    for (int row = 0; row < lattice.rows(); ++row) {
      if (distance(segment, position(Site{column, row})) <= segment.thickness / 2) {
        sites.insert({column, row});
      }
    }
  }
  const Site first = nearest_site(segment.from);
  const Site last = nearest_site(segment.to);
  const int steps = std::max(1, length_in_steps(last - first));
  const Eigen::Vector2d along = position(last) - position(first);
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d nudge(1e-6, 2e-6);
    const Site site =
        nearest_site(position(first) + along * (static_cast<double>(i) / steps) + nudge);
    if (site.column >= 0 && site.column < lattice.columns() && lattice.contains(site)) {
      sites.insert(site);
    }
  }
  return sites;
}

TEST(Reference, LinesHoldTheSitesNearThem) {
  std::mt19937 bits(3);
  for (int trial = 0; trial < 3000; ++trial) {
    const Lattice lattice(24, 17, trial % 2 == 0);
    // Half of them far out, a third of them upright, level or on whole numbers.
    const double reach = trial % 4 < 2 ? 30 : 300;
    const auto place = [&] {
      const double value = reach * (static_cast<double>(bits()) / 0x1p32) - 0.3 * reach;
      return trial % 3 == 0 ? std::round(value) : value;
    };
    Segment segment = {{place(), place()}, {place(), place()}, static_cast<double>(trial % 6)};
    if (trial % 9 == 0) {
      segment.to.x() = segment.from.x();
    } else if (trial % 9 == 3) {
      segment.to.y() = segment.from.y();
    }
    if (segment.from == segment.to) {
      continue;
    }
    const std::vector<Site> sites = sites_along(lattice, segment);
    EXPECT_TRUE(std::is_sorted(sites.begin(), sites.end()));
    EXPECT_EQ(std::set<Site>(sites.begin(), sites.end()), plain_wall(lattice, segment))
        << "from " << segment.from.transpose() << " to " << segment.to.transpose() << ", "
        << segment.thickness << " thick";
  }
}

TEST(Reference, ALongDiagonalTakesNoLongerThanItsSites) {
  const Lattice lattice(60000, 60000, false);
  const auto sites = sites_along(lattice, {{0, 0}, {50000, 59000}, 1});
  EXPECT_GT(sites.size(), 60000U);
  EXPECT_LT(sites.size(), 300000U);
}

}  // namespace
}  // namespace clca::lattice::reference_test
