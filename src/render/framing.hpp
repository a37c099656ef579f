#pragma once
// The part of the plane that a picture shows, and its scale.

#include "clca/render/painter.hpp"
#include "render/layout.hpp"
#include "render/projection.hpp"

namespace clca::render {

/// `style` with its view, or the whole box if it has none, and its size. Throws RenderError for an
/// invalid style.
Style completed(Style style, const lattice::Lattice& lattice);

/// Projection from the plane to `samples` samples per pixel along each axis.
Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         const lattice::Lattice& lattice, int picture_height);

}  // namespace clca::render
