#include "clca/contact/vessel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

namespace {

constexpr int kTurnBits = 64;
constexpr std::int32_t kMaxCentre = 1 << 30;

std::int64_t rounded(double value, int bits) {
  return std::llround(std::ldexp(value, bits));
}

void check(bool sane, const char* reason) {
  if (!sane) {
    throw std::invalid_argument(reason);
  }
}

void set_centre(Vessel& vessel, const Eigen::Vector2d& centre) {
  check((centre.array().abs() <= std::ldexp(kMaxCentre, -kCentreBits)).all(),
        "the centre of the vessel is too far away");
  vessel.centre_x = static_cast<std::int32_t>(rounded(centre.x(), kCentreBits));
  vessel.centre_y = static_cast<std::int32_t>(rounded(centre.y(), kCentreBits));
}

}  // namespace

Angle angle_of(double degrees) {
  check(std::isfinite(degrees), "an angle is no number");
  const double turns = degrees / 360;
  // Two bits fewer, as a full turn does not fit a signed number.
  return static_cast<Angle>(rounded(turns - std::floor(turns), kTurnBits - 2)) << 2U;
}

double degrees(Angle angle) {
  return std::ldexp(static_cast<double>(static_cast<std::int64_t>(angle)), -kTurnBits) * 360;
}

Vessel at_rest(const Vessel& vessel) {
  return {.angle = vessel.angle};
}

Vessel tilted(const Vessel& /*vessel*/, Angle to) {
  return {.angle = to};
}

Vessel tilting(const Vessel& vessel, Angle to, double degrees_per_step,
               const Eigen::Vector2d& centre) {
  check(degrees_per_step > 0 && degrees_per_step <= 360 * kMaxTurnsPerStep,
        "a vessel tilts too fast or not at all");
  const auto way = static_cast<std::int64_t>(to - vessel.angle);
  const double steps = std::ceil(std::abs(degrees(to - vessel.angle)) / degrees_per_step);
  check(steps < 0x1p62, "a vessel tilts too slowly");
  Vessel result = at_rest(vessel);
  if (way == 0) {
    return result;
  }
  result.turn_steps = static_cast<std::uint64_t>(steps);
  const auto turn = way / static_cast<std::int64_t>(result.turn_steps);
  result.turn = static_cast<Angle>(turn);
  set_centre(result, centre);
  return result;
}

Vessel rotating(const Vessel& vessel, double turns_per_step, const Eigen::Vector2d& centre) {
  check(std::abs(turns_per_step) <= kMaxTurnsPerStep, "a vessel turns too fast");
  Vessel result = at_rest(vessel);
  const std::int64_t turn = rounded(turns_per_step, kTurnBits);
  check(turn != 0, "a vessel does not turn");
  result.turn = static_cast<Angle>(turn);
  result.turn_steps = Vessel::kEndless;
  result.phase_step = static_cast<std::uint64_t>(std::abs(turn));
  set_centre(result, centre);
  return result;
}

Vessel shaken(const Vessel& vessel, double gamma, double cycles_per_step, bool sideways) {
  check(gamma >= 0 && gamma <= kMaxShakeGamma, "a vessel is shaken too strongly");
  check(cycles_per_step > 0 && cycles_per_step <= kMaxCyclesPerStep,
        "a vessel is shaken too fast or not at all");
  Vessel result = at_rest(vessel);
  result.strength = to_fixed_point(gamma, kRatioBits);
  result.sideways = sideways;
  result.phase_step = static_cast<std::uint64_t>(rounded(cycles_per_step, kTurnBits));
  check(result.phase_step > 0, "a vessel is shaken too slowly");
  return result;
}

Angle angle_after(const Vessel& vessel, std::uint64_t steps) {
  return vessel.angle + std::min(steps, vessel.turn_steps) * vessel.turn;
}

Eigen::Vector2d gravity_direction(const Vessel& vessel) {
  const UnitVector down = gravity_unit(vessel);
  return {std::ldexp(down.x, -kUnitBits), std::ldexp(down.y, -kUnitBits)};
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
  check(sane, "the motion of the vessel is out of range");
}

}  // namespace clca::contact
