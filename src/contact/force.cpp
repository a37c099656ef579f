#include "clca/contact/force.hpp"

#include <cmath>

#include "clca/grains/separation.hpp"
#include "contact/rule/bodies.hpp"

namespace clca::contact {

namespace {

double radius(const grains::State& state, const grains::Particle& grain) {
  return state.shape(grain).diameter() / 2;
}

/// Of a contact: on the line of centres, by the radii of discs of the same area; below a grain on a
/// wall.
Eigen::Vector2d place_of(const grains::State& state, const Contact& contact,
                         const Eigen::Vector2d& normal) {
  const grains::Particle& upper = state.particles[contact.upper];
  const Eigen::Vector2d centre = grains::centre(state, upper);
  if (!grains::is_particle(contact.other)) {
    return centre - radius(state, upper) * normal;
  }
  const grains::Particle& other = state.particles[static_cast<std::size_t>(contact.other)];
  const Eigen::Vector2d apart =
      lattice::position(grains::nearest_vector(state.lattice, upper.site(), other.site())) +
      state.shape(other).centroid() - state.shape(upper).centroid();
  return centre + radius(state, upper) / (radius(state, upper) + radius(state, other)) * apart;
}

}  // namespace

double mean_mass(const grains::State& state) {
  double sum = 0;
  double count = 0;
  for (const grains::Particle& grain : state.particles) {
    if (grain.present) {
      sum += static_cast<double>(state.shape(grain).size());
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

std::vector<Force> forces(const State& state, double gravity) {
  std::vector<Force> result;
  result.reserve(state.contacts.size());
  const double weight =
      mean_mass(state.grains) / mass_unit(state.grains.kinds) * gravity * kSpacing;
  for (const Contact& contact : state.contacts) {
    const Eigen::Vector2d normal(std::ldexp(contact.normal.x, -kUnitBits),
                                 std::ldexp(contact.normal.y, -kUnitBits));
    result.push_back({.upper = contact.upper,
                      .other = contact.other,
                      .place = place_of(state.grains, contact, normal),
                      .normal = normal,
                      .along_normal = contact.impulse.normal / weight,
                      .along_shear = contact.impulse.shear / weight});
  }
  return result;
}

std::vector<double> residuals(const grains::State& state, const std::vector<Force>& forces,
                              const Eigen::Vector2d& down) {
  const double mean = mean_mass(state);
  std::vector<Eigen::Vector2d> sums(state.particles.size(), Eigen::Vector2d::Zero());
  for (const Force& force : forces) {
    sums[force.upper] += force.on_upper();
    if (grains::is_particle(force.other)) {
      sums[static_cast<std::size_t>(force.other)] -= force.on_upper();
    }
  }
  std::vector<double> result(state.particles.size(), 0);
  for (std::size_t id = 0; id < result.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (grain.present) {
      const double weight = static_cast<double>(state.shape(grain).size()) / mean;
      result[id] = (sums[id] + weight * down).norm() / weight;
    }
  }
  return result;
}

}  // namespace clca::contact
