#include "clca/boltzmann/closure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "boltzmann/rule/solid_collision.hpp"

namespace clca::boltzmann {

namespace {

constexpr double kSolidInertia = 0.4;  // I / (m a^2)

Temperatures extrapolated(const Temperatures& begin, double duration, const Temperatures& rates) {
  return {.translational = begin.translational + duration * rates.translational,
          .rotational = begin.rotational + duration * rates.rotational};
}

Temperatures runge_kutta(const Law& law, const Temperatures& begin, double step) {
  const Temperatures first = temperature_rates(law, begin);
  const Temperatures second = temperature_rates(law, extrapolated(begin, step / 2, first));
  const Temperatures third = temperature_rates(law, extrapolated(begin, step / 2, second));
  const Temperatures fourth = temperature_rates(law, extrapolated(begin, step, third));
  Temperatures result = extrapolated(begin, step / 6, first);
  result = extrapolated(result, step / 3, second);
  result = extrapolated(result, step / 3, third);
  return extrapolated(result, step / 6, fourth);
}

}  // namespace

double maxwellian_collision_rate(double translational) {
  return 4 * std::numbers::inv_sqrtpi * std::sqrt(translational);
}

Temperatures temperature_rates(const Law& law, const Temperatures& temperatures) {
  const double t = temperatures.translational;
  if (t <= 0) {
    return {.translational = 0, .rotational = 0};
  }
  // Mean share of the velocities in V_t, at a given V_t.
  const double of_velocity = t / (t + temperatures.rotational);
  double linear = 0;     // <B V_t^2> / K over collisions, B = 1 - R
  double quadratic = 0;  // <B^2 V_t^2> / K^2
  if (law.friction > 0) {
    // V n and |V_t| are independent, Rayleigh distributed with 2 T and s^2 = 2 (T + W), and
    // B = min(c, A (V n) / |V_t|) with c = 1 + beta.
    const double cap = 1 + law.roughness;
    const double square = 2 * (t + temperatures.rotational);
    const double ratio =
        std::sqrt(square / (2 * t)) / friction_number(law);  // s / b, b^2 = 2 A^2 T
    const double stuck = square / (1 + cap * cap * ratio * ratio);
    linear = (cap * stuck + square * std::atan(cap * ratio) / ratio) / kSolidCompliance;
    quadratic = 2 * cap * cap * stuck / (kSolidCompliance * kSolidCompliance);
  }
  // Energy that a collision adds to the pair.
  const double velocities =
      -(1 - law.restitution * law.restitution) * t - linear * of_velocity + quadratic;
  const double spins = -linear * (1 - of_velocity) + quadratic / kSolidInertia;
  const double rate = maxwellian_collision_rate(t);
  return {.translational = rate / 3 * velocities, .rotational = rate / (3 * kSolidInertia) * spins};
}

Temperatures temperatures_after(const Law& law, const Temperatures& begin, double duration) {
  constexpr double kCollisionsPerStep = 0.02;
  check_valid(law);
  if (!std::isfinite(duration)) {
    throw std::invalid_argument("a duration must be finite");
  }
  Temperatures present = begin;
  for (double left = duration; left > 0;) {
    const double step =
        std::min(left, kCollisionsPerStep / maxwellian_collision_rate(present.translational));
    const Temperatures next = runge_kutta(law, present, step);
    if (next == present) {
      break;  // for ever: without losses the times may be long
    }
    present = next;
    left -= step;
  }
  return present;
}

ShearFlow steady_shear_flow(double restitution, double shear_rate) {
  if (!(restitution >= 0 && restitution < 1 && shear_rate > 0)) {
    throw std::invalid_argument("a steady shear flow needs a restitution below 1 and a shear rate");
  }
  // Steady second moments of a relaxation at the rate beta nu that also cools at zeta nu:
  // 2 a P_xy = -3 zeta nu p, a P_yy = -(beta + zeta) nu P_xy, beta p = (beta + zeta) P_yy, with nu
  // the pressure over the viscosity of elastic spheres.
  const double zeta = 5.0 / 12 * (1 - restitution * restitution);
  const double beta = (1 + restitution) * (2 + restitution) / 6;
  const double both = beta + zeta;
  const double per_collision = both * std::sqrt(3 * zeta / (2 * beta));  // a / nu
  const double frequency = 16 * std::numbers::inv_sqrtpi / 5;            // nu / sqrt(T)
  const double speed = shear_rate / (per_collision * frequency);
  return {.temperature = speed * speed,
          .p_xx = (beta + 3 * zeta) / both,
          .p_yy = beta / both,
          .p_xy = -std::sqrt(3 * zeta * beta / 2) / both};
}

}  // namespace clca::boltzmann
