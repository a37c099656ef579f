#include "grains/internal/bitboard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace clca::grains::bitboard_test {
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
          sites_set.insert({column, row});
        }
      }
    }
  }

  std::uint64_t window(Site corner) const { return bits.window(bits.corner(corner)); }
  /// As the sites were set; nothing is set beyond the border.
  std::uint64_t window_as_set(Site corner) const {
    std::uint64_t result = 0;
    for (int i = 0; i < kWindow * kWindow; ++i) {
      if (sites_set.contains({corner.column + i % kWindow, corner.row + i / kWindow})) {
        result |= std::uint64_t{1} << static_cast<unsigned>(i);
      }
    }
    return result;
  }

  lattice::Lattice lattice;
  Bitboard bits;
  std::set<std::pair<int, int>> sites_set;  ///< columns and rows
};

template <class Visit>
void for_each_corner(const lattice::Lattice& lattice, Visit visit) {
  for (int column = -kWindow; column <= lattice.columns(); ++column) {
    for (int row = -kWindow; row <= lattice.rows(); ++row) {
      visit(Site{column, row});
    }
  }
}

TEST(Bitboard, ABoxOfMoreThanTwoToTheThirtyFiveSitesIsRefused) {
  const lattice::Lattice lattice(1 << 18, 1 << 17, false);
  EXPECT_THROW(Bitboard{lattice}, std::length_error);
}

TEST(Bitboard, AWindowIsItsSitesWhereverItLies) {
  const Filled filled(lattice::Lattice(21, 70, false));
  for_each_corner(filled.lattice, [&](Site corner) {
    ASSERT_EQ(filled.window(corner), filled.window_as_set(corner))
        << corner.column << ", " << corner.row;
  });
}

TEST(Bitboard, WhatIsChangedThroughAWindowIsChangedThereAndNowhereElse) {
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
    Bitboard& bits = filled.bits;
    const Bitboard::Corner at = bits.corner(corner);
    bits.flip(at, sites);
    ASSERT_EQ(filled.window(corner), before ^ sites);
    bits.flip(at, sites, Access::shared);
    ASSERT_EQ(filled.window(corner), before);
    const std::uint64_t far = filled.window(beside);
    ASSERT_EQ(bits.set(at, sites, Access::shared), before & sites);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear(at, sites);
    ASSERT_EQ(filled.window(corner), before & ~sites);
    ASSERT_EQ(bits.set(at, sites), 0U);
    ASSERT_EQ(filled.window(corner), before | sites);
    bits.clear(at, sites);
    bits.set(at, before & sites);
    ASSERT_EQ(filled.window(corner), before);
    ASSERT_EQ(filled.window(beside), far);
  });
}

TEST(Bitboard, AWindowThatIsWipedHasNothingLeftAndNothingFarAwayIsLost) {
  for (const Access access : {Access::exclusive, Access::shared}) {
    Filled filled(lattice::Lattice(60, 60, false));
    const Site corner = {27, 29};
    const Bitboard::Corner at = filled.bits.corner(corner);
    const Filled before(filled.lattice);
    filled.bits.clear_blocks(at, access);
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

}  // namespace
}  // namespace clca::grains::bitboard_test
