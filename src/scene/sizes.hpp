#pragma once
// Species with a distribution of sizes. All functions throw SceneError.

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/key.hpp"

namespace clca::scene {

enum class SizeLaw : std::uint8_t { uniform, lognormal, list };
enum class SharesBy : std::uint8_t { number, area };
enum class RoundShape : std::uint8_t { hexagon, disc };

/// Diameters are those of circles of the same area, in lattice spacings.
struct SizeDistribution {
  SizeLaw law = SizeLaw::lognormal;
  std::optional<double> mean;  ///< for uniform and lognormal
  std::optional<double> sd;    ///< standard deviation, likewise
  SharesBy shares_by = SharesBy::number;
  std::uint64_t class_count = 8;
  std::vector<double> diameters;  ///< for SizeLaw::list
  std::vector<double> shares;     ///< likewise
  RoundShape shape = RoundShape::hexagon;
};

struct SizeClass {
  double radius = 0;         ///< as in DiscSpec or HexagonSpec
  double weight_in_law = 1;  ///< its number of sites if the law is by area, else 1
  double diameter = 0;       ///< lattice::Shape::diameter(), in spacings; not twice the radius
  double share = 0;          ///< of all particles, by number
};

/// Size classes from the smallest to the largest, each once. List: the lattice sizes nearest
/// to its diameters. Uniform and lognormal: the range is divided into equal classes (lognormal:
/// without half a percent at each end); each is represented by the two lattice sizes around its
/// mean diameter, weighted to keep that mean (by number or by area, as the law).
std::vector<SizeClass> size_classes(const SizeDistribution& sizes);

Type<SizeDistribution> sizes_type();
/// Replaces each species with `sizes` by one species for each size class, NAME-1 the smallest, and
/// divides its counts and weights in fills and sources among them. Classes of which no fill gets a
/// particle are left out. `scene` gives the units.
void expand_sizes(Value& root, const Scene& scene);

}  // namespace clca::scene
