// Random boxes: a painter that draws only what has changed draws the same as a fresh one.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <functional>

#include "clca/render/coloring.hpp"
#include "clca/render/painter.hpp"
#include "property/random_motions.hpp"

namespace clca::pictures_test {
namespace {

using automaton::Automaton;
using grains::State;

/// All of the box, a part of it, or a part that the box does not fill.
lattice::Rectangle any_view() {
  if (*rc::gen::arbitrary<bool>()) {
    return {};
  }
  const double left = testing::within(-10, 20);
  const double bottom = testing::within(-10, 30);
  return {left, bottom, left + testing::within(1, 40) / 1.7, bottom + testing::within(1, 40) / 1.3};
}

using ColoringOf = std::function<render::Coloring(const State&, const grains::Occupancy&)>;

ColoringOf any_coloring() {
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return
          [](const State& state, const auto& /*occupancy*/) { return render::color_by_id(state); };
    case 1:
      return [](const State& state, const auto& occupancy) {
        return render::color_by_force(state, occupancy, {0, 4});
      };
    case 2:
      return [](const State& state, const auto& /*occupancy*/) {
        return render::color_by_layer(state, 3, {0, 30});
      };
    default:
      return [high = static_cast<double>(testing::within(1, 20))](const State& state,
                                                                  const auto& /*occupancy*/) {
        return render::color_by_displacement(state, {0, high});
      };
  }
}

/// An outlet at the floor, half of the time.
void add_outlet(State& state) {
  if (*rc::gen::arbitrary<bool>()) {
    const double left = testing::within(0, 10);
    state.outlets = {{.region = {left, -1, left + 12, 6}}};
  }
}

RC_GTEST_PROP(PictureProperty, OneOfWhatHasChangedEqualsAFreshOne, ()) {
  auto [state, rules] = testing::any_moving_state(testing::MovingWalls::any);
  add_outlet(state);
  Automaton automaton(state, rules);
  const render::Style style = {.width = testing::within(20, 150),
                               .height = testing::within(20, 150),
                               .supersampling = testing::within(1, 5),
                               .view = any_view(),
                               .annotations = render::Annotations::none,
                               .threads = testing::within(1, 3)};
  const auto fresh = [&, &beginning = state] {
    return render::Painter(style, beginning.lattice, beginning.kinds);
  };
  render::Painter painter = fresh();
  ColoringOf coloring_of = any_coloring();
  const double turn = *rc::gen::element(0, 0, 0, 30, -90);
  for (int number = 0; number < 12; ++number) {
    State shown = automaton.state();
    for (grains::Wall& wall : shown.walls) {  // which then is not to move all the time
      if (wall.passive_rule == grains::PassiveRule::rigid && testing::within(0, 4) == 0) {
        wall.sites = grains::current_sites(shown.lattice, wall);
        wall.motion.reset();
      }
    }
    if (testing::within(0, 5) == 0) {
      coloring_of = any_coloring();
    }
    const grains::Occupancy occupancy(shown);
    const render::Coloring coloring = coloring_of(shown, occupancy);
    render::Painter other = fresh();
    RC_ASSERT(painter.rasterize(painter.capture(shown, occupancy, coloring), {}, {}, turn) ==
              other.rasterize(other.capture(shown, occupancy, coloring), {}, {}, turn));
    const int steps = testing::within(0, 4);
    for (int step = 0; step < steps; ++step) {
      automaton.step();
    }
  }
}

}  // namespace
}  // namespace clca::pictures_test
