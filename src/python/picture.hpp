#pragma once
// Pictures as arrays.

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "clca/image/image.hpp"
#include "clca/scene/parse.hpp"

namespace clca::python {

/// `output.frames` of the scene with these overrides; defaults where it has none. Throws
/// scene::SceneError.
scene::Frames frames_of(const scene::Scene& scene, std::vector<scene::Override> overrides);

/// Rows from the top x columns x 3, of bytes.
pybind11::array pixels(const image::Image& image);

}  // namespace clca::python
