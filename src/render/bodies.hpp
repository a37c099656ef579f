#pragma once
// Particles as polygons, for vector graphics.

#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/render/body.hpp"
#include "clca/render/coloring.hpp"
#include "render/graphics.hpp"
#include "render/projection.hpp"

namespace clca::render {

/// A particle in view.
struct Body {
  std::uint16_t kind = 0;
  GridPoint place;  ///< of the reference site
  Rgb fill;
};

/// Overlapping particles: the lower id last, so that it lies on top.
std::vector<Body> bodies_in_view(const Projection& projection, const grains::State& state,
                                 const grains::Occupancy& occupancy, const Coloring& coloring);

void draw(Graphics& graphics, std::span<const Body> bodies, std::span<const Outline> outlines,
          const Projection& projection, const PanelScale& panel);

}  // namespace clca::render
