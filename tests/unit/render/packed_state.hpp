#pragma once
// States to draw.

#include "clca/automaton/automaton.hpp"
#include "clca/render/painter.hpp"

namespace clca::render {

grains::State empty_state(int columns, int rows, bool periodic);

/// Hexagons, rods, triangles and hooks, tumbled for some steps; with an upright wall unless the box
/// is periodic, where particles lie across the seam.
automaton::Automaton to_sample(int columns, int rows, bool periodic);

/// A picture of `state` without annotations. `samples`: a pixel along each axis.
Image picture(const grains::State& state, DrawingMethod drawing, int width, int height, int samples,
              const lattice::Rectangle& view = {});

}  // namespace clca::render
