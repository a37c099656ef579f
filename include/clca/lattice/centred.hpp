#pragma once
// Shapes about their middle.

#include "clca/lattice/shape.hpp"

namespace clca::lattice {

/// The shape with the site nearest to its centre of mass as reference, so that the origin of the
/// scene's coordinates does not matter.
Shape centred(const Shape& shape);

}  // namespace clca::lattice
