#pragma once
// Where particles were, to tell later how far they have come.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/grains/state.hpp"

namespace clca::measure {

/// What a particle did between two moments, in lattice spacings.
struct Journey {
  Eigen::Vector2d from;          ///< its centre of mass at first, in the box
  Eigen::Vector2d displacement;  ///< across a periodic seam too
  double sites = 0;              ///< of the particle: its mass
};

/// The centres of mass of the particles at one moment.
class Snapshot {
 public:
  /// Of an empty box.
  Snapshot() = default;
  explicit Snapshot(const grains::State& state);

  std::uint64_t step() const { return step_; }
  /// Journeys since then of the particles present at both moments, by id. Throws
  /// std::invalid_argument where `now` is earlier or has fewer particles.
  std::vector<Journey> journeys(const grains::State& now) const;

  /// False where this was not taken in a run that has come to `now`.
  bool precedes(const grains::State& now) const;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("step", &Snapshot::step_), field("centres", &Snapshot::centres_));
  }

 private:
  std::uint64_t step_ = 0;
  std::vector<std::optional<Eigen::Vector2d>> centres_;  // by id; none of removed particles
};

}  // namespace clca::measure
