#include "clca/automaton/site_bits.hpp"

#include <gtest/gtest.h>

#include <random>

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
      const Site site = {corner.column + i / kWindow, corner.row + i % kWindow};
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

TEST(SiteBits, AWindowIsItsSitesWhereverItLies) {
  const Filled filled(lattice::Lattice(21, 70, false));
  for_each_corner(filled.lattice, [&](Site corner) {
    ASSERT_EQ(filled.bits.window(corner), filled.window(corner))
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
    const std::uint64_t sites = random() & random();
    const std::uint64_t before = filled.window(corner);
    const Site beside = {corner.column + 3, corner.row - 5};
    SiteBits& bits = filled.bits;
    bits.flip(corner, sites);
    ASSERT_EQ(filled.window(corner), before ^ sites);
    bits.flip_shared(corner, sites);
    ASSERT_EQ(filled.window(corner), before);
    const std::uint64_t far = filled.window(beside);
    ASSERT_EQ(bits.set_shared(corner, sites), before & sites);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear_shared(corner, sites);
    ASSERT_EQ(filled.window(corner), before & ~sites);
    bits.set(corner, sites);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear(corner, sites);
    bits.set(corner, before & sites);
    ASSERT_EQ(filled.window(corner), before);
    ASSERT_EQ(filled.window(beside), far);
  });
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

TEST(AwakeSet, GivesEachIdOnceInOrderAndIsEmptyThen) {
  AwakeSet set;
  set.resize(100'000);
  std::vector<std::uint32_t> expected = {0, 63, 64, 4095, 4096, 99'999};
  for (const std::uint32_t id : {99'999U, 64U, 0U, 4096U, 63U, 4095U, 64U}) {
    set.insert(id);
  }
  std::vector<std::uint32_t> ids;
  const auto take = [&](std::uint32_t id) { ids.push_back(id); };
  set.drain(take);
  EXPECT_EQ(ids, expected);
  set.drain(take);
  EXPECT_EQ(ids, expected);
}

TEST(Strips, AreCutWhereTheWorkIsAndStayApart) {
  State state{.lattice = lattice::Lattice(1600, 10, false)};
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  Strips strips(state, 4);
  EXPECT_EQ(strips.of(0), 0U);
  EXPECT_EQ(strips.of(1599), 3U);
  std::vector<std::vector<std::uint32_t>> loads(4, strips.no_load());
  for (int column = 800; column < 1600; ++column) {
    Strips::note(loads[static_cast<std::size_t>(column) % 4], column, 1);
  }
  std::vector<std::vector<std::uint32_t>*> all;
  for (auto& load : loads) {
    all.push_back(&load);
  }
  strips.balance(all);
  for (std::size_t strip = 0; strip < 4; ++strip) {
    const int middle = 800 + 200 * static_cast<int>(strip) + 100;
    EXPECT_EQ(strips.of(middle), strip);
    EXPECT_TRUE(strips.inner(strip).contains(middle));
    if (strip > 0) {
      EXPECT_LT(strips.inner(strip - 1).end + kWindow, strips.inner(strip).first);
    }
  }
  EXPECT_EQ(loads, std::vector(4, strips.no_load()));
}

}  // namespace
}  // namespace clca::automaton
