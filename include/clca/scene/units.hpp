#pragma once
// From lattice spacings and steps of the contact model to the units of a run.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/scene/scene.hpp"

namespace clca::scene {

/// Metres and seconds where the scene has units, otherwise what follows from a lattice spacing and
/// gravity alone.
struct Conversion {
  std::string length_unit;    ///< m or spacing
  std::string time_unit;      ///< s or √(spacing/gravity)
  std::string velocity_unit;  ///< m/s or √(spacing·gravity)
  double spacing = 1;         ///< a lattice spacing, in the unit of length
  double time_step = 1;       ///< in the unit of time

  bool operator==(const Conversion&) const = default;

  /// In the unit of time.
  double time(std::uint64_t steps) const { return static_cast<double>(steps) * time_step; }
  /// `0.3124 s`: with as many decimals as tell one step from the next.
  std::string time_text(std::uint64_t steps) const;
  /// From lattice spacings per step to the unit of velocity.
  double velocity(double spacings_per_step) const {
    return spacings_per_step * spacing / time_step;
  }
};

/// Of a scene of the contact model, whose resolution and fall height give a time step; none of the
/// automaton, whose steps have no length.
std::optional<Conversion> conversion(const Scene& scene);

/// The least whole number of steps, but 0, that takes `time`. A time that is that of a step but for
/// rounding is that step.
double steps_until(double time, const Conversion& conversion);

}  // namespace clca::scene
