#include "packed_state.hpp"

#include <array>

#include "clca/render/coloring.hpp"

namespace clca::render {

grains::State empty_state(int columns, int rows, bool periodic) {
  return {.lattice = lattice::Lattice(columns, rows, periodic), .seed = 2001};
}

automaton::Automaton to_sample(int columns, int rows, bool periodic) {
  constexpr std::array<lattice::Axial, 3> kTriangle = {{{0, 0}, {3, 0}, {0, 3}}};
  grains::State state = empty_state(columns, rows, periodic);
  state.kinds = {{lattice::Shape::hexagon(1), 0},
                 {lattice::Shape::hexagon(2), 1},
                 {lattice::Shape::rod(0, 4).rotated(1), 2},
                 {lattice::Shape::polygon(kTriangle), 3},
                 {lattice::Shape({{0, 0}, {1, 0}, {2, -1}, {2, -2}, {1, -2}}), 4}};
  const double width = lattice::kColumnPitch * columns;
  if (!periodic) {
    state.walls = {
        {lattice::sites_in(state.lattice, {width / 2, 0, width / 2 + 1.5, rows * 0.6}), true}};
  }
  automaton::Automaton automaton(std::move(state));
  const auto each = static_cast<std::size_t>(columns * rows / 120);
  const std::array<std::size_t, 5> counts = {each, each, each, each, each};
  automaton.fill({-1, -1, width + 1, static_cast<double>(rows)}, counts);
  for (int i = 0; i < 15; ++i) {
    automaton.step();
  }
  return automaton;
}

Image picture(const grains::State& state, DrawingMethod drawing, int width, int height, int samples,
              const lattice::Rectangle& view) {
  Style style;
  style.width = width;
  style.height = height;
  style.supersampling = samples;
  style.drawing = drawing;
  style.view = view;
  style.annotations = Annotations::none;
  Painter painter(style, state.lattice, state.kinds);
  return painter.draw(state, grains::Occupancy(state), color_by_id(state), {});
}

}  // namespace clca::render
