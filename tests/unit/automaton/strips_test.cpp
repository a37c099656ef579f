#include "automaton/engine/strips.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "grains/internal/bitboard.hpp"

namespace clca::automaton::strips_test {
namespace {

using lattice::Site;

WindowedFootprints footprints_of(const grains::State& state) {
  return {state, candidate_directions({})};
}

/// What 800 columns or rows of a box have to do, shared out among four.
std::vector<WorkHistogram> loads_of(const Strips& strips, bool columns) {
  std::vector<WorkHistogram> loads(4, strips.empty_histogram());
  for (int line = 800; line < 1600; ++line) {
    const Site site = columns ? Site{line, 5} : Site{5, line};
    loads[static_cast<std::size_t>(line) % 4].add(site, 1);
  }
  return loads;
}

TEST(Strips, AreCutWhereTheWorkIsAndStayApart) {
  for (const bool columns : {true, false}) {
    grains::State state{.lattice = columns ? lattice::Lattice(1600, 10, false)
                                           : lattice::Lattice(10, 1600, false)};
    state.kinds = {{lattice::Shape::hexagon(1), 0}};
    Strips strips(state.lattice, footprints_of(state), 4);
    std::vector<WorkHistogram> loads = loads_of(strips, columns);
    std::vector<WorkHistogram*> all;
    for (WorkHistogram& load : loads) {
      all.push_back(&load);
    }
    strips.balance(all);
    for (std::size_t strip = 0; strip < 4; ++strip) {
      const int line = 800 + 200 * static_cast<int>(strip) + 100;
      const Site middle = columns ? Site{line, 5} : Site{5, line};
      EXPECT_EQ(strips.strip_of(middle), strip);
      EXPECT_TRUE(strips.inner_interval(strip).contains(middle));
      EXPECT_EQ(strips.inner_interval(strip).axis, columns ? Axis::columns : Axis::rows);
      if (strip > 0) {
        EXPECT_LT(strips.inner_interval(strip - 1).end + grains::kWindow,
                  strips.inner_interval(strip).first);
      }
    }
    for (const WorkHistogram& load : loads) {
      EXPECT_EQ(load.work_by_line, strips.empty_histogram().work_by_line);
    }
  }
}

// A bar that lies to the right of its reference site, in windows of its own.
TEST(Strips, KeepAsFarApartAsWindowsReach) {
  grains::State state{.lattice = lattice::Lattice(400, 400, true)};
  state.kinds = {{lattice::Shape({{0, 0}, {1, 0}, {2, 0}}), 0}};
  const WindowedFootprints footprints = footprints_of(state);
  const Strips strips(state.lattice, footprints, 2);
  for (const WindowedFootprint& footprint : footprints.all()) {
    ASSERT_TRUE(footprint.fits_one_window);
    const int last = footprint.lower_left.column + grains::kWindow - 1;
    EXPECT_GT(last, 4);
    EXPECT_TRUE(strips.at_periodic_boundary({400 - last, 9}));
    EXPECT_LE(strips.inner_interval(0).end - 1 + last,
              200 + footprint.lower_left.column - 2 * grains::kWindow);
  }
}

TEST(WindowedFootprint, AllThatASmallHexagonReachesIsInOneWindow) {
  using enum lattice::Direction;
  constexpr std::array kCandidates = {down, down_right, down_left};
  grains::State state{.lattice = lattice::Lattice(40, 40, false)};
  for (const int radius : {0, 1, 2, 3}) {
    state.kinds = {{lattice::Shape::hexagon(radius), 0}};
    const WindowedFootprints table(state, kCandidates);
    for (const int column : {10, 11}) {
      EXPECT_EQ(table.footprint(0, column).fits_one_window, radius < 3) << radius;
    }
  }
}

}  // namespace
}  // namespace clca::automaton::strips_test
