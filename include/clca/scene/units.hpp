#pragma once
// Conversion from lattice spacings and steps of the contact model to units of output.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/scene/scene.hpp"

namespace clca::scene {

/// Metres and seconds if the scene has units, else units derived from lattice spacing and gravity.
struct Conversion {
  std::string length_unit;    ///< m or spacing
  std::string time_unit;      ///< s or √(spacing/gravity)
  std::string velocity_unit;  ///< m/s or √(spacing·gravity)
  double spacing = 1;         ///< a lattice spacing, in the unit of length
  double time_step = 1;       ///< in the unit of time

  bool operator==(const Conversion&) const = default;

  /// Time of a step, in the unit of time.
  double time(std::uint64_t steps) const { return static_cast<double>(steps) * time_step; }
  /// `0.3124 s`, with enough decimals to distinguish steps.
  std::string time_text(std::uint64_t steps) const;
  /// From lattice spacings per step to the unit of velocity.
  double velocity(double spacings_per_step) const {
    return spacings_per_step * spacing / time_step;
  }
};

/// For contact scenes; none for the automaton, whose steps have no length.
std::optional<Conversion> conversion(const Scene& scene);

/// Smallest positive number of steps that takes at least `time`, up to rounding.
double steps_until(double time, const Conversion& conversion);

}  // namespace clca::scene
