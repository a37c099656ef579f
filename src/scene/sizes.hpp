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
  std::optional<double> mean;  ///< of uniform and lognormal
  std::optional<double> sd;    ///< standard deviation, likewise
  SharesBy by = SharesBy::number;
  std::uint64_t kinds = 8;
  std::vector<double> diameters;  ///< of a list
  std::vector<double> shares;     ///< likewise
  RoundShape shape = RoundShape::hexagon;
};

struct SizeClass {
  double radius = 0;         ///< as in DiscSpec or HexagonSpec
  double weight_in_law = 1;  ///< of a particle: its sites if the law is by area, else 1
  /// Of the circle of equal area, spacings, as lattice::Shape::diameter(); not twice the radius.
  double diameter = 0;
  double share = 0;  ///< of the particles, by number; the sum is 1 but for rounding
};

/// The kinds of particles of the law, from the smallest to the largest. Of a list: those nearest to
/// its diameters. Of uniform and lognormal: of each of `kinds` classes, the two around its mean
/// diameter, with the same mean (by number or by area, as the law). The classes have equal width;
/// of lognormal, the outermost take half a percent more at each end. Those with the same sites are
/// one.
std::vector<SizeClass> size_classes(const SizeDistribution& sizes);

Type<SizeDistribution> sizes_type();
/// Replaces each species with `sizes` by one species for each of its kinds, NAME-1 the smallest,
/// and its counts and weights in fills and sources by theirs. Kinds of which no fill gets any are
/// left out. The scene has the units.
void expand_sizes(Value& root, const Scene& scene);

}  // namespace clca::scene
