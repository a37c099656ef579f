#include "contact/rule/bodies.hpp"

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

  double inverse_inertia() const { return 2 * inverse_mass * inverse_radius * inverse_radius; }
};

Disc disc(const grains::Kind& kind, double unit) {
  const auto sites = static_cast<double>(kind.shape.size());
  return {unit / sites, std::sqrt(2 * std::numbers::pi / (sites * std::numbers::sqrt3))};
}

Pair make_pair(const Disc& upper, const Disc& other, Rolling rolling) {
  const double mass = 1 / (upper.inverse_mass + other.inverse_mass);
  const double inverse_radius = upper.inverse_radius + other.inverse_radius;  // reduced
  const double inertia = 1 / (upper.inverse_inertia() + other.inverse_inertia());
  const auto rolling_mass = [&](const Disc& disc) {
    return to_fixed_point(inertia * inverse_radius * disc.inverse_radius, kMassBits);
  };
  const auto turning = [&](const Disc& disc) {
    return to_fixed_point(disc.inverse_mass * disc.inverse_radius / inverse_radius,
                          kInverseMassBits);
  };
  // At the rim a disc yields to a force twice as much by turning as by moving.
  const double shear_mass = rolling == Rolling::none ? mass : mass / 3;
  return {.mass = to_fixed_point(mass, kMassBits),
          .shear_mass = to_fixed_point(shear_mass, kMassBits),
          .upper_inverse_mass = to_fixed_point(upper.inverse_mass, kInverseMassBits),
          .other_inverse_mass = to_fixed_point(other.inverse_mass, kInverseMassBits),
          .upper_rolling_mass = rolling_mass(upper),
          .other_rolling_mass = rolling_mass(other),
          .upper_turning = turning(upper),
          .other_turning = turning(other)};
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

Bodies::Bodies(const std::vector<grains::Kind>& kinds, Rolling rolling) : kinds_(kinds.size()) {
  const double unit = mass_unit(kinds);
  for (const grains::Kind& kind : kinds) {
    for (const grains::Kind& other : kinds) {
      pairs_.push_back(make_pair(disc(kind, unit), disc(other, unit), rolling));
    }
    pairs_.push_back(make_pair(disc(kind, unit), Disc(), rolling));
  }
}

std::optional<UnitVector> normal_between(const lattice::Shape& first, const lattice::Shape& second,
                                         lattice::Axial apart) {
  lattice::Axial blocked;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::vector<lattice::Axial> lead = first.lead(direction);
    if (std::any_of(lead.begin(), lead.end(),
                    [&](lattice::Axial site) { return second.contains(site - apart); })) {
      blocked = blocked + unit(direction);
    }
  }
  if (blocked == lattice::Axial()) {
    return std::nullopt;
  }
  const bool hexagons = first.is_hexagon() && second.is_hexagon();
  return unit_vector(lattice::Axial() - (hexagons ? apart : blocked));
}

}  // namespace clca::contact
