#pragma once
// How the vessel that holds the grains stands and moves. Grains are described in its own frame, in
// which it rests and gravity turns or swings.

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "clca/fields/fields.hpp"

namespace clca::contact {

/// Anticlockwise, in 2^-64 turns: a whole turn is 0 again.
using Angle = std::uint64_t;

/// Of finite degrees, as near as a double has it.
Angle angle_of(double degrees);
/// From -180 up to, but not, 180.
double degrees(Angle angle);

/// Turns, or is shaken, or rests. Made by the functions below.
struct Vessel {
  static constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

  Angle angle = 0;               ///< from upright
  Angle turn = 0;                ///< in a step, while it turns; clockwise ones wrap around
  std::uint64_t turn_steps = 0;  ///< for which it still turns
  std::int32_t centre_x = 0;     ///< of turning, in 2^-8 lattice spacings
  std::int32_t centre_y = 0;
  /// Greatest acceleration by shaking over gravity, in 2^-16.
  std::int32_t strength = 0;
  bool sideways = false;           ///< shaken across gravity, not along it
  std::uint64_t phase = 0;         ///< of turning without end or shaking, in 2^-64 cycles
  std::uint64_t phase_step = 0;    ///< in a step
  std::uint64_t whole_cycles = 0;  ///< of these since it began

  bool operator==(const Vessel&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(
        field("angle", &Vessel::angle), field("turn", &Vessel::turn),
        field("turn_steps", &Vessel::turn_steps), field("centre_x", &Vessel::centre_x),
        field("centre_y", &Vessel::centre_y), field("strength", &Vessel::strength),
        field("sideways", &Vessel::sideways), field("phase", &Vessel::phase),
        field("phase_step", &Vessel::phase_step), field("whole_cycles", &Vessel::whole_cycles));
  }
  bool moves() const { return turn_steps > 0 || phase_step > 0; }
};

inline constexpr double kMostTurnsPerStep = 1.0 / 64;
inline constexpr double kMostCyclesPerStep = 1.0 / 16;
inline constexpr double kStrongestShaking = 1000;  ///< times gravity

// All of them leave the angle as it is, where nothing else is said. They throw
// std::invalid_argument for numbers beyond the bounds above.

/// Stops all motion.
Vessel at_rest(const Vessel& vessel);
/// Stands at an angle at once.
Vessel tilted(const Vessel& vessel, Angle to);
/// Turns to an angle, the shorter way, by at most `degrees_per_step` (above 0), about the centre,
/// which is in lattice spacings.
Vessel tilting(const Vessel& vessel, Angle to, double degrees_per_step,
               const Eigen::Vector2d& centre);
/// Turns without end; anticlockwise where the rate is above 0.
Vessel rotating(const Vessel& vessel, double turns_per_step, const Eigen::Vector2d& centre);
/// Swings as a sine along gravity, or across it, with `gamma` times the acceleration of gravity at
/// the most. Begins in the middle, upwards or to the right.
Vessel shaken(const Vessel& vessel, double gamma, double cycles_per_step, bool sideways);

/// At which it stands after some steps.
Angle angle_after(const Vessel& vessel, std::uint64_t steps);

/// Of length 1: where gravity points without shaking.
Eigen::Vector2d gravity_direction(const Vessel& vessel);

/// Throws std::invalid_argument for a vessel that none of these functions makes.
void check_valid(const Vessel& vessel);

}  // namespace clca::contact
