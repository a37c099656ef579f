#pragma once
// How grains at rest would pass their weight on to those below them, by rules that know nothing of
// impulses. They observe a bed of any model, and move nothing.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// Who takes the force of a grain: the nearest, the farthest or a drawn support to the left of it
/// and one to the right (after Herrmann, Hemmingsson & Roux 1997), or all, in drawn shares of the
/// vertical part (`q`, Coppersmith et al. 1996).
enum class WeightRule : std::uint8_t { inner, outer, pair, q };
inline constexpr std::array kWeightRules = {WeightRule::inner, WeightRule::outer, WeightRule::pair,
                                            WeightRule::q};

/// For each body beside a grain, the sum of the directions to its sites, each from a site of the
/// grain: opposite for the two of a pair. The floor is contact::kFloor; other sides are left out.
std::map<grains::Owner, lattice::Axial> touched_bodies(const grains::State& state,
                                                       const grains::Occupancy& occupancy,
                                                       std::uint32_t id);

/// A grain, and what lies below it.
struct SupportedGrain {
  struct Support {
    grains::Owner body = 0;
    Eigen::Vector2d direction;  ///< of length 1, from the grain; points down
  };
  std::uint32_t id = 0;
  std::vector<Support> supports = {};  ///< ordered by body
};

/// All grains from the top, by the heights of their centres, then by id; each supports only those
/// before it. Throws std::invalid_argument for the occupancy of another box, or overlaps.
std::vector<SupportedGrain> supported_grains(const grains::State& state,
                                             const grains::Occupancy& occupancy);

/// The supports of all grains are the edges of a graph in the plane: fewer, over their number.
inline constexpr double kSupportsPerGrain = 3;

/// Memory of supported_grains() and of the paths by one rule, at most.
inline double weight_paths_bytes(double particles) {
  return particles *
         (sizeof(SupportedGrain) + sizeof(Eigen::Vector2d) + sizeof(double) +
          kSupportsPerGrain * (grains::kListCapacityRatio * sizeof(SupportedGrain::Support) +
                               sizeof(contact::Force)));
}

struct WeightPaths {
  /// Forces in weights of a grain of mean mass, from the top; each along its normal, without shear.
  std::vector<contact::Force> forces = {};
  std::size_t one_sided_grains = 0;    ///< grains with no support on one side of their force
  std::size_t unsupported_grains = 0;  ///< grains with no support at all, where their force ends
};

/// The forces on the supports. Draws depend on seed and step of the state.
WeightPaths weight_paths(const grains::State& state, const std::vector<SupportedGrain>& grains,
                         WeightRule rule);

/// Equal parts of the base of a bed, which reaches from where 1 % of the sites of its grains lie
/// further left to where 1 % lie further right (each grain by its centre).
struct BedBase {
  static constexpr int kBinCount = 13;
  double left = 0;  ///< lattice spacings
  double right = 0;

  double width() const { return right - left; }
};
BedBase bed_base(const grains::State& state);

/// Downward force on floor and walls in each bin over the mean of the bins, from the contacts whose
/// normal points up; a point between two bins counts half in each. Empty if that mean is 0.
std::vector<double> base_pressures(const BedBase& base, const std::vector<contact::Force>& forces);

/// Pressure of the middle bin less the mean of the three bins on either side; not for an empty
/// list.
double centre_minus_ring(const std::vector<double>& pressure);

}  // namespace clca::measure
