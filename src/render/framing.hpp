#pragma once
// Which part of the plane a picture shows, and how large.

#include "clca/render/painter.hpp"
#include "render/layout.hpp"
#include "render/projection.hpp"

namespace clca::render {

/// The view of `style`, or the whole box where it has none. Throws RenderError for a style that
/// makes no sense.
lattice::Rectangle checked_view(const Style& style, const lattice::Lattice& lattice);

/// From the plane to `samples` samples along each axis of a pixel of the panel.
Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         const lattice::Lattice& lattice, int picture_height);

}  // namespace clca::render
