#pragma once
// Orientation and motion of the vessel. Grains are described in the frame of the vessel, in which
// gravity turns or oscillates.

#include <Eigen/Core>
#include <cstdint>
#include <limits>

#include "clca/lattice/direction.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::contact {

/// Anticlockwise angle in 2^-64 turns; a full turn is 0.
using Angle = std::uint64_t;

/// The angle of finite degrees, to the precision of a double.
Angle angle_from_degrees(double degrees);
/// The angle in degrees, in [-180, 180).
double to_degrees(Angle angle);

/// A vessel at rest, turning or shaken. Made by the functions below.
struct Vessel {
  static constexpr std::uint64_t kEndlessSteps =
      std::numeric_limits<std::uint64_t>::max();  ///< number of steps

  Angle angle = 0;               ///< from upright
  Angle turn = 0;                ///< change of angle in a step; clockwise ones wrap around
  std::uint64_t turn_steps = 0;  ///< steps for which it still turns
  std::int32_t centre_x = 0;     ///< of turning, in 2^-8 lattice spacings
  std::int32_t centre_y = 0;
  /// Peak acceleration of shaking divided by gravity, in 2^-16.
  std::int32_t strength = 0;
  bool sideways = false;           ///< shaken across gravity, not along it
  std::uint64_t phase = 0;         ///< of endless turning or of shaking, in 2^-64 cycles
  std::uint64_t phase_step = 0;    ///< change of phase in a step
  std::uint64_t whole_cycles = 0;  ///< since endless turning or shaking began

  bool operator==(const Vessel&) const = default;
  CLCA_FIELDS(angle, turn, turn_steps, centre_x, centre_y, strength, sideways, phase, phase_step,
              whole_cycles);
  bool is_moving() const { return turn_steps > 0 || phase_step > 0; }
};

inline constexpr double kMaxTurnsPerStep = 1.0 / 64;
inline constexpr double kMaxCyclesPerStep = 1.0 / 16;
inline constexpr double kMaxShakeGamma = 1000;  ///< times gravity

// Copies of a vessel with another motion. Unless stated otherwise they keep the angle; numbers
// beyond the bounds above throw std::invalid_argument.

/// The vessel, stopped.
Vessel without_motion(const Vessel& vessel);
/// Turns to an angle, the shorter way, by at most `degrees_per_step` (positive) about `centre`
/// (lattice spacings).
Vessel with_tilting(const Vessel& vessel, Angle to, double degrees_per_step,
                    const Eigen::Vector2d& centre);
/// Turns continuously; anticlockwise for a positive rate.
Vessel with_rotation(const Vessel& vessel, double turns_per_step, const Eigen::Vector2d& centre);
/// Sinusoidal shaking along or across gravity with peak acceleration `gamma` times gravity. Starts
/// in the middle, upwards or to the right.
Vessel with_shaking(const Vessel& vessel, double gamma, double cycles_per_step, bool sideways);

/// The angle after some steps.
Angle angle_after(const Vessel& vessel, std::uint64_t steps);

/// Unit vector of gravity without shaking.
Eigen::Vector2d gravity_direction(const Vessel& vessel);
/// The lattice direction nearest to gravity without shaking; found in whole numbers.
lattice::Direction down(const Vessel& vessel);

/// Throws std::invalid_argument for a vessel that none of these functions can make.
void check_valid(const Vessel& vessel);

}  // namespace clca::contact
