#include "clca/contact/vessel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/rule/moves.hpp"

namespace clca::contact {

namespace {

constexpr int kTurnBits = 64;                 // of Angle
constexpr std::int32_t kMaxCentre = 1 << 30;  // in units of Vessel::centre_x

/// to_fixed_point() of any size.
std::int64_t to_long_fixed_point(double value, int bits) {
  return std::llround(std::ldexp(value, bits));
}

void set_centre(Vessel& vessel, const Eigen::Vector2d& centre) {
  require((centre.array().abs() <= std::ldexp(kMaxCentre, -kCentreBits)).all(),
          "the centre of the vessel is too far away");
  vessel.centre_x = static_cast<std::int32_t>(to_long_fixed_point(centre.x(), kCentreBits));
  vessel.centre_y = static_cast<std::int32_t>(to_long_fixed_point(centre.y(), kCentreBits));
}

constexpr Angle kQuarterTurn = Angle{1} << 62U;

/// Sine in 2^-30. By its series, as library versions differ between machines.
std::int32_t sine(Angle angle) {
  constexpr int kLastPower = 15;
  const bool falling = (angle & kQuarterTurn) != 0;
  const bool negative = (angle & 2 * kQuarterTurn) != 0;
  const double share = std::ldexp(static_cast<double>((angle % kQuarterTurn) >> 9U), -53);
  const double x = (falling ? 1 - share : share) * std::numbers::pi / 2;
  double sum = 1;
  for (int power = kLastPower; power > 1; power -= 2) {
    sum = 1 - x * x / (power * (power - 1)) * sum;
  }
  const auto size = static_cast<std::int32_t>(std::llround(std::ldexp(x * sum, kUnitBits)));
  return negative ? -size : size;
}

std::int32_t cosine(Angle angle) {
  return sine(angle + kQuarterTurn);
}

Vector vector_along(const UnitVector& unit, std::int32_t size) {
  return {rounded(product(unit.x, size), kUnitBits), rounded(product(unit.y, size), kUnitBits)};
}

}  // namespace

Angle angle_from_degrees(double degrees) {
  require(std::isfinite(degrees), "an angle is no number");
  const double turns = degrees / 360;
  // Two bits fewer, as a full turn does not fit a signed number.
  return static_cast<Angle>(to_long_fixed_point(turns - std::floor(turns), kTurnBits - 2)) << 2U;
}

double to_degrees(Angle angle) {
  return std::ldexp(static_cast<double>(static_cast<std::int64_t>(angle)), -kTurnBits) * 360;
}

Vessel without_motion(const Vessel& vessel) {
  return {.angle = vessel.angle};
}

Vessel with_tilting(const Vessel& vessel, Angle to, double degrees_per_step,
                    const Eigen::Vector2d& centre) {
  require(degrees_per_step > 0 && degrees_per_step <= 360 * kMaxTurnsPerStep,
          "a vessel tilts too fast or not at all");
  const auto way = static_cast<std::int64_t>(to - vessel.angle);
  const double steps = std::ceil(std::abs(to_degrees(to - vessel.angle)) / degrees_per_step);
  require(steps < 0x1p62, "a vessel tilts too slowly");
  Vessel result = without_motion(vessel);
  if (way == 0) {
    return result;
  }
  result.turn_steps = static_cast<std::uint64_t>(steps);
  const auto turn = way / static_cast<std::int64_t>(result.turn_steps);
  result.turn = static_cast<Angle>(turn);
  set_centre(result, centre);
  return result;
}

Vessel with_rotation(const Vessel& vessel, double turns_per_step, const Eigen::Vector2d& centre) {
  require(std::abs(turns_per_step) <= kMaxTurnsPerStep, "a vessel turns too fast");
  Vessel result = without_motion(vessel);
  const std::int64_t turn = to_long_fixed_point(turns_per_step, kTurnBits);
  require(turn != 0, "a vessel does not turn");
  result.turn = static_cast<Angle>(turn);
  result.turn_steps = Vessel::kEndlessSteps;
  result.phase_step = static_cast<std::uint64_t>(std::abs(turn));
  set_centre(result, centre);
  return result;
}

Vessel with_shaking(const Vessel& vessel, double gamma, double cycles_per_step, bool sideways) {
  require(gamma >= 0 && gamma <= kMaxShakeGamma, "a vessel is shaken too strongly");
  require(cycles_per_step > 0 && cycles_per_step <= kMaxCyclesPerStep,
          "a vessel is shaken too fast or not at all");
  Vessel result = without_motion(vessel);
  result.strength = to_fixed_point(gamma, kRatioBits);
  result.sideways = sideways;
  result.phase_step = static_cast<std::uint64_t>(to_long_fixed_point(cycles_per_step, kTurnBits));
  require(result.phase_step > 0, "a vessel is shaken too slowly");
  return result;
}

Angle angle_after(const Vessel& vessel, std::uint64_t steps) {
  return vessel.angle + std::min(steps, vessel.turn_steps) * vessel.turn;
}

UnitVector gravity_unit_vector(const Vessel& vessel) {
  return {-sine(vessel.angle), -cosine(vessel.angle)};
}

lattice::Direction down(const Vessel& vessel) {
  // Gravity turns clockwise in the frame of a vessel that turns anticlockwise.
  const Angle sixths = (vessel.angle >> 32U) * lattice::kDirectionCount + (Angle{1} << 31U);
  return lattice::rotated(lattice::Direction::down, static_cast<int>(sixths >> 32U));
}

Acceleration acceleration(const Vessel& vessel, std::int32_t gravity, bool periodic) {
  const UnitVector along = gravity_unit_vector(vessel);
  Acceleration result = {.gravity = vector_along(along, gravity)};
  // In the vessel grains feel the opposite of its acceleration: along its displacement.
  const std::int32_t strongest = rounded(product(gravity, vessel.strength), kRatioBits);
  const std::int32_t shaking = rounded(product(strongest, sine(vessel.phase)), kUnitBits);
  const Vector swing = vector_along(
      vessel.sideways ? UnitVector{-along.y, along.x} : UnitVector{-along.x, -along.y}, shaking);
  result.gravity = {result.gravity.x + swing.x, result.gravity.y + swing.y};
  result.has_centrifugal = vessel.turn_steps > 0 && !periodic;
  if (result.has_centrifugal) {
    const double radians =
        static_cast<double>(static_cast<std::int64_t>(vessel.turn)) * 2 * std::numbers::pi;
    result.angular_velocity =
        static_cast<std::int32_t>(std::llround(std::ldexp(radians, kRateBits - 64)));
    result.squared_angular_velocity = product(result.angular_velocity, result.angular_velocity) >>
                                      (2 * kRateBits - kSquaredRateBits);
    result.centre_x = vessel.centre_x;
    result.centre_y = vessel.centre_y;
  }
  return result;
}

Vessel vessel_after_step(const Vessel& vessel) {
  Vessel result = vessel;
  result.angle = angle_after(vessel, 1);
  if (vessel.turn_steps > 0 && vessel.turn_steps != Vessel::kEndlessSteps) {
    --result.turn_steps;
  }
  result.phase += vessel.phase_step;
  result.whole_cycles += result.phase < vessel.phase ? 1 : 0;
  return result;
}

Eigen::Vector2d gravity_direction(const Vessel& vessel) {
  return as_double(gravity_unit_vector(vessel));
}

void check_valid(const Vessel& vessel) {
  const auto size = [](std::uint64_t turn) {
    return std::abs(std::ldexp(static_cast<double>(static_cast<std::int64_t>(turn)), -kTurnBits));
  };
  const auto in_range = [](std::int32_t value) {
    return value >= -kMaxCentre && value <= kMaxCentre;
  };
  const bool sane = size(vessel.turn) <= kMaxTurnsPerStep &&
                    size(vessel.phase_step) <= kMaxCyclesPerStep && vessel.strength >= 0 &&
                    vessel.strength <= to_fixed_point(kMaxShakeGamma, kRatioBits) &&
                    in_range(vessel.centre_x) && in_range(vessel.centre_y);
  require(sane, "the motion of the vessel is out of range");
}

}  // namespace clca::contact
