#pragma once
// Neighbours of particles: their number and species; how particles mix or separate by size.

#include <cstdint>
#include <optional>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

/// Number of other particles and walls that touch or overlap each particle; by id, 0 for removed
/// particles. All sides of the box count as one wall. `occupancy` belongs to `state`.
std::vector<int> coordination_numbers(const grains::State& state,
                                      const grains::Occupancy& occupancy);

/// Share of neighbouring grains that have the same axis; a third at random. None without a pair.
std::optional<double> axis_order(const grains::State& state);

/// Two grains that were neighbours.
struct NeighbourPair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t passed = 0;  ///< mean diameters that they have fallen, rounded down

  CLCA_FIELDS(first, second, passed);
};

/// Sums over pairs, each at the first step at which it has fallen by some distance.
struct FallenPairs {
  std::uint64_t pairs = 0;
  std::uint64_t kept = 0;  ///< of these, still neighbours
  double fallen = 0;       ///< distances that they have fallen, lattice spacings
  double spread = 0;       ///< squared differences of their displacements in x

  double kept_share() const { return static_cast<double>(kept) / static_cast<double>(pairs); }
  /// Diffusion of one grain relative to the other per distance fallen, lattice spacings: the mean
  /// of (dx_1 - dx_2)^2 over four times the mean distance.
  double diffusion() const { return spread / (4 * fallen); }
  CLCA_FIELDS(pairs, kept, fallen, spread);
};

/// Follows all pairs of neighbours of one moment. The distance that a pair has fallen is the mean
/// of both, against y. A pair ends when one of them is removed.
class Mixing {
 public:
  /// Largest distance of the centres of neighbours, at the start and later, in mean diameters: a
  /// small change of the packing parts none.
  static constexpr double kMaxNeighbourDistance = 1.35;
  static constexpr double kMaxKeptDistance = 1.49;

  /// Bytes for so many particles, with what is needed for a time.
  static double bytes_for(double particles) {
    constexpr double kPairs = 3;  // of a particle: lines between neighbours hardly cross
    return Snapshot::bytes_for(particles) +
           particles * (sizeof(std::optional<Displacement>) +
                        kPairs * grains::kListCapacityRatio * sizeof(NeighbourPair));
  }

  Mixing() = default;  ///< without pairs
  explicit Mixing(const grains::State& state);

  /// Call after each step. Throws std::invalid_argument for a state of another run.
  void add(const grains::State& now);

  /// Mean diameter of the particles at the start, see lattice::Shape::diameter.
  double mean_diameter() const { return diameter_; }
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  /// Element i: sums over the pairs that have fallen i + 1 mean diameters.
  const std::vector<FallenPairs>& fallen_pairs() const { return fallen_; }

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  CLCA_FIELDS(begin_, diameter_, pairs_, fallen_);

 private:
  Snapshot begin_;
  double diameter_ = 0;
  std::vector<NeighbourPair> pairs_;
  std::vector<FallenPairs> fallen_;
};

// The size of a species is its number of sites; species of equal size count as one. The floor of a
// bed is the lower edge of its lowest particle site.

/// Mean height of the largest particles minus that of the smallest (centres of mass), divided by
/// half the bed height; the bed height is twice the mean height of all particle sites.
/// 1 if two equal halves are separated with the large particles on top, -1 the other way round, 0
/// if mixed. None unless two sizes are present.
std::optional<double> segregation_index(const grains::State& state);

/// Mixing index of Lacey (1954), M = (s0^2 - s^2) / (s0^2 - sr^2), on a Grid of side `cell`
/// (lattice spacings): 0 if separated, 1 on average if mixed at random. s^2: variance of the share
/// of the largest particles over cells, by number, weighted by particles. s0^2 = p (1 - p),
/// separated. sr^2 = p (1 - p) (C - 1) / (N - 1), the exact expectation over random permutations of
/// N particles in C cells. None unless two sizes are present, some cell holds more than one
/// particle, and a cell has room for two of the largest.
std::optional<double> lacey_index(const grains::State& state, double cell);

/// Height of an intruder, the only particle of its species: 0 on the floor of the bed, 1 if its top
/// is level with the mean surface of the others, larger above. Resolution half a spacing. None
/// unless exactly one species has one particle, and the bed is deeper than the intruder is high.
std::optional<double> intruder_height(const grains::State& state);

}  // namespace clca::measure
