#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "clca/scene/walls.hpp"

namespace clca::scene::circle_test {
namespace {

using lattice::Direction;
using lattice::kDirections;
using lattice::Lattice;
using lattice::position;
using lattice::Site;
using lattice::SweptRegion;
using lattice::unit;

using Sites = std::set<Site>;

Sites as_set(const std::vector<Site>& sites) {
  EXPECT_TRUE(std::is_sorted(sites.begin(), sites.end()));
  Sites result(sites.begin(), sites.end());
  EXPECT_EQ(result.size(), sites.size());
  return result;
}

template <class Inside>
Sites sites_where(const Lattice& lattice, Inside inside) {
  Sites sites;
  for (int column = 0; column < lattice.columns(); ++column) {
    for (int row = 0; row < lattice.rows(); ++row) {
      if (inside(position(Site{column, row}))) {
        sites.insert({column, row});
      }
    }
  }
  return sites;
}

/// Sites reached from `start` by unit steps beside `wall`.
Sites flooded(const Lattice& lattice, const Sites& wall, Site start) {
  Sites wet = {start};
  std::vector<Site> open = {start};
  while (!open.empty()) {
    const Site site = open.back();
    open.pop_back();
    for (const Direction direction : kDirections) {
      const Site next = site + unit(direction);
      if (lattice.contains(next) && !wall.contains(next) && wet.insert(next).second) {
        open.push_back(next);
      }
    }
  }
  return wet;
}

double angle_of(const Eigen::Vector2d& vector) {
  return std::atan2(vector.y(), vector.x()) * 180 / std::numbers::pi;
}

TEST(Circle, DiscsAndRingsHoldTheSitesAtTheirDistance) {
  std::mt19937 bits(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(bits()) / 0x1p32);
  };
  for (int trial = 0; trial < 500; ++trial) {
    const Lattice lattice(24, 17, trial % 2 == 0);
    const Eigen::Vector2d centre(between(-20, 40), between(-20, 40));
    const double radius = between(0, 30);
    const double thickness = between(0, 6);
    const auto distance = [&](const Eigen::Vector2d& point) { return (point - centre).norm(); };
    EXPECT_EQ(as_set(sites_in(SweptRegion(lattice), Disc{centre, radius})),
              sites_where(lattice, [&](const auto& point) { return distance(point) <= radius; }));
    EXPECT_EQ(as_set(sites_in(SweptRegion(lattice), Ring{centre, radius, thickness})),
              sites_where(lattice, [&](const auto& point) {
                return distance(point) >= radius && distance(point) <= radius + thickness;
              }));
  }
}

TEST(Circle, AnArcIsThePartOfItsRingBetweenItsAngles) {
  std::mt19937 bits(6);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(bits()) / 0x1p32);
  };
  const Lattice lattice(40, 36, false);
  for (int trial = 0; trial < 1000; ++trial) {
    const Ring ring = {{between(5, 25), between(5, 25)}, between(1, 15), between(1, 5)};
    const double from = between(-360, 360);
    const double to = from + (trial % 5 == 0 ? between(0.001, 2) : between(2, 359.9));
    Sites expected;
    for (const Site site : sites_in(SweptRegion(lattice), ring)) {
      const double beyond = std::fmod(angle_of(position(site) - ring.centre) - from + 1080, 360);
      if (beyond <= to - from) {
        expected.insert(site);
      }
    }
    EXPECT_EQ(as_set(sites_in(SweptRegion(lattice), Arc{ring, from, to})), expected)
        << from << " to " << to;
  }
}

TEST(Circle, SitesOnTheEdgeAreInside) {
  const Lattice lattice(100, 100, false);
  const Site middle = {40, 40};
  for (const int steps : {1, 7, 30}) {
    const Disc disc = {position(middle), static_cast<double>(steps)};
    const Sites sites = as_set(sites_in(SweptRegion(lattice), disc));
    for (const Direction direction : kDirections) {
      const lattice::Axial way = {steps * unit(direction).x, steps * unit(direction).q};
      EXPECT_TRUE(sites.contains(middle + way)) << steps;
    }
  }
  // Six sites at the corners of a hexagon, 60 degrees apart: both ends count.
  const Ring ring = {position(middle), 1, 0.5};
  EXPECT_EQ(sites_in(SweptRegion(lattice), ring).size(), 6U);
  for (int from = -330; from <= 210; from += 60) {
    EXPECT_EQ(sites_in(SweptRegion(lattice), Arc{ring, from + 0.0, from + 60.0}).size(), 2U)
        << from;
    EXPECT_EQ(sites_in(SweptRegion(lattice), Arc{ring, from + 0.0, from + 180.0}).size(), 4U)
        << from;
    EXPECT_EQ(sites_in(SweptRegion(lattice), Arc{ring, from + 0.0, from + 300.0}).size(), 6U)
        << from;
    EXPECT_EQ(sites_in(SweptRegion(lattice), Arc{ring, from + 1.0, from + 59.0}).size(), 0U)
        << from;
    EXPECT_EQ(sites_in(SweptRegion(lattice), Arc{ring, from + 1.0, from + 359.0}).size(), 5U)
        << from;
  }
}

TEST(Circle, ARingOneSpacingThickIsClosed) {
  std::mt19937 bits(7);
  const Lattice lattice(70, 60, false);
  for (int trial = 0; trial < 300; ++trial) {
    const auto off_by = [&] { return static_cast<double>(bits()) / 0x1p32; };
    // Half of them around a site with a radius of whole spacings: sites on both edges.
    const bool even = trial % 2 == 0;
    const Site middle = {35, 30};
    const Ring ring = {position(middle) + Eigen::Vector2d(even ? 0 : off_by(), even ? 0 : off_by()),
                       even ? 2.0 + trial % 23 : 2 + 22 * off_by(), 1};
    const Sites wet = flooded(lattice, as_set(sites_in(SweptRegion(lattice), ring)), middle);
    EXPECT_EQ(wet, sites_where(lattice,
                               [&](const auto& point) {
                                 return (point - ring.centre).norm() < ring.radius - 1e-6;
                               }))
        << "around " << ring.centre.transpose() << ", radius " << ring.radius;
  }
}

TEST(Circle, HoldsNoSiteSaysWhetherThereAreAny) {
  const Lattice lattice(30, 30, false);
  EXPECT_TRUE(holds_no_site(lattice, Disc{{-5, 10}, 4.9}));
  EXPECT_FALSE(holds_no_site(lattice, Disc{{-5, 10}, 5}));
  EXPECT_TRUE(holds_no_site(lattice, Ring{{10, 10}, 60, 3}));
  EXPECT_FALSE(holds_no_site(lattice, Ring{{10, 10}, 8, 1}));
  EXPECT_TRUE(holds_no_site(lattice, Arc{{{0, 0}, 8, 1}, 100, 350}));
  EXPECT_FALSE(holds_no_site(lattice, Arc{{{0, 0}, 8, 1}, 80, 350}));
}

TEST(Circle, WideOnesTakeNoLongerThanTheirEdges) {
  const Lattice lattice(1'000'000, 1'000'000, false);
  EXPECT_FALSE(holds_no_site(lattice, Disc{{0, 0}, 1e6}));
  EXPECT_TRUE(holds_no_site(lattice, Disc{{-7e5, -7e5}, 9.5e5}));  // its rectangle has many
  EXPECT_TRUE(holds_no_site(lattice, Ring{{4e5, 5e5}, 1e6, 1}));
  EXPECT_FALSE(sites_in(SweptRegion(lattice), Ring{{4e5, 5e5}, 1e5, 1}).empty());
}

TEST(Circle, OnlyTheSitesThatComeInAreTaken) {
  const SweptRegion above(Lattice(20, 10, false), Direction::down, 0, 30);
  const Disc disc = {{8, 25}, 3};
  const Lattice high(20, 60, false);
  EXPECT_EQ(sites_in(above, disc), sites_in(SweptRegion(high), disc));
  EXPECT_TRUE(sites_in(SweptRegion(Lattice(20, 10, false)), disc).empty());
}

}  // namespace
}  // namespace clca::scene::circle_test
