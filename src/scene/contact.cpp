#include "clca/scene/contact.hpp"

#include <algorithm>

#include "clca/lattice/lattice.hpp"

namespace clca::scene {

namespace {

/// Area of particles in squared lattice spacings.
double area(const Scene& scene, const std::vector<std::size_t>& counts) {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sum += static_cast<double>(counts[i]) * static_cast<double>(scene.species[i].shape.size());
  }
  return sum * lattice::kColumnPitch;
}

double estimated_fall(const Scene& scene) {
  constexpr double kPacking = 0.8;
  constexpr double kLeast = 10;
  double filled = 0;
  double width = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.fill) {
      const lattice::Rectangle& region = stage.fill->region;
      filled += area(scene, stage.fill->counts);
      width = std::max(width, std::min(region.right, scene.box.width) - std::max(region.left, 0.0));
    }
  }
  const bool endless = std::any_of(scene.sources.begin(), scene.sources.end(),
                                   [](const Source& source) { return !source.count; });
  if (endless || width <= 0) {
    return std::max(kLeast, scene.box.height);
  }
  return std::clamp(filled / (kPacking * width), kLeast, std::max(kLeast, scene.box.height));
}

}  // namespace

contact::Parameters contact_parameters(const Scene& scene) {
  contact::Parameters parameters = scene.contact;
  if (parameters.fall_height == 0) {
    parameters.fall_height = estimated_fall(scene);
  }
  return parameters;
}

}  // namespace clca::scene
