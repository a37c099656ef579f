#pragma once
// Mixing in a flow: which neighbours stay together while they fall, and how far they part sideways.

#include <cstdint>
#include <vector>

#include "clca/measure/snapshot.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::measure {

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
  /// Of one grain relative to the other, over the distance fallen instead of time: the mean of
  /// (dx_1 - dx_2)^2 over four times the mean distance, lattice spacings.
  double diffusion() const { return spread / (4 * fallen); }
  CLCA_FIELDS(pairs, kept, fallen, spread);
};

/// Follows all pairs of neighbours of one moment. The distance that a pair has fallen is the mean
/// of both, against y. A pair ends when one of them is removed.
class Mixing {
 public:
  /// Largest distance of the centres of neighbours, at the start and later, in mean diameters: a
  /// small change of the packing parts none.
  static constexpr double kNear = 1.35;
  static constexpr double kStillNear = 1.49;

  /// Bytes for so many particles, with what is needed for a time.
  static double bytes_for(double particles) {
    constexpr double kPairs = 3;  // of a particle: lines between neighbours hardly cross
    return Snapshot::bytes_for(particles) +
           particles * (sizeof(std::optional<Displacement>) +
                        kPairs * grains::kListRoom * sizeof(NeighbourPair));
  }

  /// Without pairs.
  Mixing() = default;
  explicit Mixing(const grains::State& state);

  /// Call after each step. Throws std::invalid_argument for a state of another run.
  void add(const grains::State& now);

  /// Mean diameter of the particles at the start, see lattice::Shape::diameter.
  double diameter() const { return diameter_; }
  const std::vector<NeighbourPair>& pairs() const { return pairs_; }
  /// Element i is of pairs that have fallen i + 1 mean diameters.
  const std::vector<FallenPairs>& fallen() const { return fallen_; }

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  CLCA_FIELDS(begin_, diameter_, pairs_, fallen_);

 private:
  Snapshot begin_;
  double diameter_ = 0;
  std::vector<NeighbourPair> pairs_;
  std::vector<FallenPairs> fallen_;
};

}  // namespace clca::measure
