#pragma once
// The part of the plane that a picture shows, and its scale.

#include "clca/render/painter.hpp"
#include "render/layout.hpp"
#include "render/projection.hpp"

namespace clca::render {

/// The view of `style`, or the whole box if it has none. Throws RenderError for an invalid style.
lattice::Rectangle checked_view(const Style& style, const lattice::Lattice& lattice);

/// Projection from the plane to `samples` samples per pixel along each axis.
Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         const lattice::Lattice& lattice, int picture_height);

}  // namespace clca::render
