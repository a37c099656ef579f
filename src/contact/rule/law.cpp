#include "contact/rule/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clca::contact {

namespace {

/// A disc of the same area, in units of mass and lattice spacings. A wall has infinite mass.
struct Disc {
  double inverse_mass = 0;
  double inverse_radius = 0;
};

Disc disc(const grains::Kind& kind, double unit) {
  const auto sites = static_cast<double>(kind.shape.size());
  return {unit / sites, std::sqrt(2 * std::numbers::pi / (sites * std::numbers::sqrt3))};
}

PairCoefficients make_coefficients(const Disc& upper, const Disc& other) {
  // Impulses carried over act as springs of stiffness M / step^2. The ratios are common in DEM and
  // softer than what stops slip or rolling in one step (M, or M/3 with rotation; about 2 M).
  // Stiffer contacts lock in excess pressure.
  constexpr double kShearStiffness = 2.0 / 7;
  constexpr double kRollingStiffness = 0.3;  // of a moment over the reduced radius squared
  const double mass = 1 / (upper.inverse_mass + other.inverse_mass);
  const double inverse_radius = upper.inverse_radius + other.inverse_radius;  // reduced
  const auto rolling_mass = [&](const Disc& disc) {
    return to_fixed_point(kRollingStiffness * mass * disc.inverse_radius / inverse_radius,
                          kMassBits);
  };
  const auto turning = [&](const Disc& disc) {
    return to_fixed_point(disc.inverse_mass * disc.inverse_radius / inverse_radius,
                          kInverseMassBits);
  };
  return {.mass = to_fixed_point(mass, kMassBits),
          .shear_mass = to_fixed_point(kShearStiffness * mass, kMassBits),
          .upper_inverse_mass = to_fixed_point(upper.inverse_mass, kInverseMassBits),
          .other_inverse_mass = to_fixed_point(other.inverse_mass, kInverseMassBits),
          .upper_rolling_mass = rolling_mass(upper),
          .other_rolling_mass = rolling_mass(other),
          .upper_rolling_response = turning(upper),
          .other_rolling_response = turning(other)};
}

}  // namespace

double mass_unit(const std::vector<grains::Kind>& kinds) {
  constexpr double kMany = 16;           // sites
  constexpr double kMaxInverseMass = 8;  // which 2^-26 leave room for
  double least = std::numeric_limits<double>::infinity();
  double most = 1;
  for (const grains::Kind& kind : kinds) {
    const auto sites = static_cast<double>(kind.shape.size());
    least = std::min(least, sites);
    most = std::max(most, sites);
  }
  double unit = 1;
  while (kMany * unit < most && 2 * unit <= kMaxInverseMass * least) {
    unit *= 2;
  }
  return unit;
}

std::vector<PairCoefficients> all_pair_coefficients(const std::vector<grains::Kind>& kinds) {
  std::vector<PairCoefficients> pairs;
  const double unit = mass_unit(kinds);
  for (const grains::Kind& kind : kinds) {
    for (const grains::Kind& other : kinds) {
      pairs.push_back(make_coefficients(disc(kind, unit), disc(other, unit)));
    }
    pairs.push_back(make_coefficients(disc(kind, unit), Disc()));
  }
  return pairs;
}

Rule make_rule(const grains::State& state, const Parameters& parameters, double gravity) {
  const auto ratio = [](double value, double most) {
    require(value >= 0 && value <= most, "a parameter of the contact model is out of range");
    return to_fixed_point(value, kRatioBits);
  };
  const auto friction = [&](double value) { return ratio(value, kMaxFriction); };
  require(parameters.sweeps > 0, "a parameter of the contact model is out of range");
  Rule rule = {.gravity = to_fixed_point(gravity, kFractionBits),
               .restitution = ratio(parameters.restitution, std::nextafter(1.0, 0.0)),
               .sweeps = parameters.sweeps,
               .friction = friction(parameters.friction),
               .side_friction = friction(parameters.wall_friction),
               .wall_friction = std::vector<std::int32_t>(state.walls.size(),
                                                          friction(parameters.wall_friction)),
               .law = {.rotates = parameters.rolling != Rolling::none,
                       .resists_rolling = parameters.rolling == Rolling::resistance,
                       .rolling_friction = friction(parameters.rolling_friction)},
               .pair_coefficients = all_pair_coefficients(state.kinds)};
  require(parameters.friction_by_wall.size() <= state.walls.size(),
          "there are more frictions than walls");
  for (std::size_t wall = 0; wall < parameters.friction_by_wall.size(); ++wall) {
    rule.wall_friction[wall] =
        friction(parameters.friction_by_wall[wall].value_or(parameters.wall_friction));
  }
  for (const grains::Kind& kind : state.kinds) {
    require(!rule.law.rotates || kind.shape.is_round(),
            "only hexagons and discs turn: others need Rolling::none");
  }
  return rule;
}

}  // namespace clca::contact
