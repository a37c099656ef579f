#include "clca/automaton/site_bits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/strips.hpp"
#include "clca/automaton/footprint.hpp"

namespace clca::automaton {
namespace {

using lattice::Site;

/// A box whose sites, and those of its border, are set at random.
struct Filled {
  explicit Filled(const lattice::Lattice& box) : lattice(box), bits(box) {
    std::mt19937 random(1);
    for (int column = -1; column <= lattice.columns(); ++column) {
      for (int row = -1; row <= lattice.rows(); ++row) {
        if (random() % 2 == 0) {
          bits.set(lattice.index({column, row}));
        }
      }
    }
  }

  /// Bit by bit; nothing is set beyond the border.
  std::uint64_t window(Site corner) const {
    std::uint64_t result = 0;
    for (int i = 0; i < kWindow * kWindow; ++i) {
      const Site site = {corner.column + i % kWindow, corner.row + i / kWindow};
      const bool inside = site.column >= -1 && site.column <= lattice.columns() && site.row >= -1 &&
                          site.row <= lattice.rows();
      if (inside && bits.test(lattice.index(site))) {
        result |= std::uint64_t{1} << static_cast<unsigned>(i);
      }
    }
    return result;
  }

  lattice::Lattice lattice;
  SiteBits bits;
};

template <class Visit>
void for_each_corner(const lattice::Lattice& lattice, Visit visit) {
  for (int column = -kWindow; column <= lattice.columns(); ++column) {
    for (int row = -kWindow; row <= lattice.rows(); ++row) {
      visit(Site{column, row});
    }
  }
}

TEST(SiteBits, ABoxOfMoreThanTwoToTheThirtyFiveSitesIsRefused) {
  const lattice::Lattice lattice(1 << 18, 1 << 17, false);
  EXPECT_THROW(SiteBits{lattice}, std::length_error);
}

TEST(SiteBits, AWindowIsItsSitesWhereverItLies) {
  const Filled filled(lattice::Lattice(21, 70, false));
  for_each_corner(filled.lattice, [&](Site corner) {
    ASSERT_EQ(filled.bits.window(filled.bits.corner(corner)), filled.window(corner))
        << corner.column << ", " << corner.row;
  });
}

TEST(SiteBits, WhatIsChangedThroughAWindowIsChangedThereAndNowhereElse) {
  std::mt19937_64 random(2);
  Filled filled(lattice::Lattice(21, 30, false));
  for_each_corner(filled.lattice, [&](Site corner) {
    const bool inside = corner.column >= -1 && corner.row >= -1 &&
                        corner.column + kWindow <= filled.lattice.columns() &&
                        corner.row + kWindow <= filled.lattice.rows();
    if (!inside) {
      return;
    }
    const std::uint64_t half = random();
    const std::uint64_t sites = half & random();
    const std::uint64_t before = filled.window(corner);
    const Site beside = {corner.column + 3, corner.row - 5};
    SiteBits& bits = filled.bits;
    const SiteBits::Corner at = bits.corner(corner);
    bits.flip(at, sites);
    ASSERT_EQ(filled.window(corner), before ^ sites);
    bits.flip_shared(at, sites);
    ASSERT_EQ(filled.window(corner), before);
    const std::uint64_t far = filled.window(beside);
    ASSERT_EQ(bits.set_shared(at, sites), before & sites);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear(at, sites);
    ASSERT_EQ(filled.window(corner), before & ~sites);
    bits.set(at, sites);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear(at, sites);
    bits.set(at, before & sites);
    ASSERT_EQ(filled.window(corner), before);
    ASSERT_EQ(filled.window(beside), far);
  });
}

TEST(SiteBits, AWindowThatIsWipedHasNothingLeftAndNothingFarAwayIsLost) {
  for (const bool shared : {false, true}) {
    Filled filled(lattice::Lattice(60, 60, false));
    const Site corner = {27, 29};
    const SiteBits::Corner at = filled.bits.corner(corner);
    const Filled before = filled;
    shared ? filled.bits.wipe_shared(at) : filled.bits.wipe(at);
    EXPECT_EQ(filled.window(corner), 0U);
    for_each_corner(filled.lattice, [&](Site other) {
      const bool far = std::abs(other.column - corner.column) >= 2 * kWindow ||
                       std::abs(other.row - corner.row) >= 2 * kWindow + kWindow;
      if (far) {
        ASSERT_EQ(filled.window(other), before.window(other));
      }
    });
  }
}

TEST(Footprint, AllThatASmallHexagonReachesIsInOneWindow) {
  State state{.lattice = lattice::Lattice(40, 40, false)};
  for (const int radius : {0, 1, 2, 3}) {
    state.kinds = {{lattice::Shape::hexagon(radius), 0}};
    const FootprintTable table(state);
    for (const int column : {10, 11}) {
      EXPECT_EQ(table.of({.column = column}).one_window, radius < 3) << radius;
    }
  }
}

std::vector<std::uint32_t> listed(const AwakeSet& set) {
  return {set.listed().begin(), set.listed().end()};
}

TEST(AwakeSet, HasEachIdOnceInTheOrderInWhichTheyCame) {
  AwakeSet set;
  set.resize(100'000);
  for (const std::uint32_t id : {99'999U, 64U, 0U, 4096U, 63U, 4095U, 64U}) {
    set.insert(id);
  }
  const std::vector<std::uint32_t> expected = {99'999, 64, 0, 4096, 63, 4095};
  EXPECT_EQ(listed(set), expected);
  EXPECT_TRUE(set.contains(63));
  EXPECT_FALSE(set.contains(62));
  set.clear();
  EXPECT_TRUE(set.empty());
  EXPECT_FALSE(set.contains(63));
}

TEST(AwakeSet, HasThoseMarkedWithoutListingThem) {
  AwakeSet set;
  set.resize(100);
  set.mark(7);
  set.insert(7);
  set.insert(8);
  EXPECT_TRUE(set.contains(7));
  EXPECT_EQ(listed(set), std::vector<std::uint32_t>{8});
  set.list_marked();
  EXPECT_EQ(listed(set), (std::vector<std::uint32_t>{8, 7}));
  set.mark(9);
  set.clear();
  EXPECT_TRUE(set.empty());
  EXPECT_FALSE(set.contains(7) || set.contains(8) || set.contains(9));
}

/// What 800 columns or rows of a box have to do, shared out among four.
std::vector<Load> loads_of(const Strips& strips, bool columns) {
  std::vector<Load> loads(4, strips.no_load());
  for (int line = 800; line < 1600; ++line) {
    const Site site = columns ? Site{line, 5} : Site{5, line};
    loads[static_cast<std::size_t>(line) % 4].note(site, 1);
  }
  return loads;
}

TEST(Strips, AreCutWhereTheWorkIsAndStayApart) {
  for (const bool columns : {true, false}) {
    State state{.lattice = columns ? lattice::Lattice(1600, 10, false)
                                   : lattice::Lattice(10, 1600, false)};
    state.kinds = {{lattice::Shape::hexagon(1), 0}};
    Strips strips(state.lattice, FootprintTable(state), 4);
    std::vector<Load> loads = loads_of(strips, columns);
    std::vector<Load*> all;
    for (Load& load : loads) {
      all.push_back(&load);
    }
    strips.balance(all);
    for (std::size_t strip = 0; strip < 4; ++strip) {
      const int line = 800 + 200 * static_cast<int>(strip) + 100;
      const Site middle = columns ? Site{line, 5} : Site{5, line};
      EXPECT_EQ(strips.of(middle), strip);
      EXPECT_TRUE(strips.inner(strip).contains(middle));
      EXPECT_EQ(strips.inner(strip).axis, columns ? Axis::columns : Axis::rows);
      if (strip > 0) {
        EXPECT_LT(strips.inner(strip - 1).end + kWindow, strips.inner(strip).first);
      }
    }
    for (const Load& load : loads) {
      EXPECT_EQ(load.lines, strips.no_load().lines);
    }
  }
}

// A bar that lies to the right of its reference site, in windows of its own.
TEST(Strips, KeepAsFarApartAsWindowsReach) {
  State state{.lattice = lattice::Lattice(400, 400, true)};
  state.kinds = {{lattice::Shape({{0, 0}, {1, 0}, {2, 0}}), 0}};
  const FootprintTable footprints(state);
  const Strips strips(state.lattice, footprints, 2);
  for (const Footprint& footprint : footprints.all()) {
    ASSERT_TRUE(footprint.one_window);
    const int last = footprint.corner.column + kWindow - 1;
    EXPECT_GT(last, 4);
    EXPECT_TRUE(strips.at_seam({400 - last, 9}));
    EXPECT_LE(strips.inner(0).end - 1 + last, 200 + footprint.corner.column - 2 * kWindow);
  }
}

}  // namespace
}  // namespace clca::automaton
