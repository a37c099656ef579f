#include "contact/rule/acceleration.hpp"

#include <cmath>
#include <numbers>

namespace clca::contact {

namespace {

constexpr Angle kQuarter = Angle{1} << 62U;

/// In 2^-30. By its series, as library versions differ between machines.
std::int32_t sine(Angle angle) {
  constexpr int kLastPower = 15;
  const bool falling = (angle & kQuarter) != 0;
  const bool negative = (angle & 2 * kQuarter) != 0;
  const double share = std::ldexp(static_cast<double>((angle % kQuarter) >> 9U), -53);
  const double x = (falling ? 1 - share : share) * std::numbers::pi / 2;
  double sum = 1;
  for (int power = kLastPower; power > 1; power -= 2) {
    sum = 1 - x * x / (power * (power - 1)) * sum;
  }
  const auto size = static_cast<std::int32_t>(std::llround(std::ldexp(x * sum, kUnitBits)));
  return negative ? -size : size;
}

std::int32_t cosine(Angle angle) {
  return sine(angle + kQuarter);
}

Vector scaled_by(const UnitVector& unit, std::int32_t size) {
  return {rounded(product(unit.x, size), kUnitBits), rounded(product(unit.y, size), kUnitBits)};
}

}  // namespace

UnitVector gravity_unit(const Vessel& vessel) {
  return {-sine(vessel.angle), -cosine(vessel.angle)};
}

lattice::Direction down(const Vessel& vessel) {
  // Gravity turns clockwise in the frame of a vessel that turns anticlockwise.
  const Angle sixths = (vessel.angle >> 32U) * lattice::kDirectionCount + (Angle{1} << 31U);
  return lattice::rotated(lattice::Direction::down, static_cast<int>(sixths >> 32U));
}

Acceleration acceleration(const Vessel& vessel, std::int32_t gravity, bool periodic) {
  const UnitVector along = gravity_unit(vessel);
  Acceleration result = {.gravity = scaled_by(along, gravity)};
  // In the vessel grains feel the opposite of its acceleration, which is opposite to its
  // displacement.
  const std::int32_t strongest = rounded(product(gravity, vessel.strength), kRatioBits);
  const std::int32_t shaking = rounded(product(strongest, sine(vessel.phase)), kUnitBits);
  const Vector swing = scaled_by(
      vessel.sideways ? UnitVector{-along.y, along.x} : UnitVector{-along.x, -along.y}, shaking);
  result.gravity = {result.gravity.x + swing.x, result.gravity.y + swing.y};
  result.turns = vessel.turn_steps > 0 && !periodic;
  if (result.turns) {
    const double radians =
        static_cast<double>(static_cast<std::int64_t>(vessel.turn)) * 2 * std::numbers::pi;
    result.rate = static_cast<std::int32_t>(std::llround(std::ldexp(radians, kRateBits - 64)));
    result.squared_rate = product(result.rate, result.rate) >> (2 * kRateBits - kCentrifugalBits);
    result.centre_x = vessel.centre_x;
    result.centre_y = vessel.centre_y;
  }
  return result;
}

Vessel next(const Vessel& vessel) {
  Vessel result = vessel;
  result.angle = angle_after(vessel, 1);
  if (vessel.turn_steps > 0 && vessel.turn_steps != Vessel::kEndless) {
    --result.turn_steps;
  }
  result.phase += vessel.phase_step;
  result.whole_cycles += result.phase < vessel.phase ? 1 : 0;
  return result;
}

}  // namespace clca::contact
