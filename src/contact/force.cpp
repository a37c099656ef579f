#include "clca/contact/force.hpp"

#include <algorithm>

#include "contact/rule/numbers.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

namespace {

/// Sets point and branch of a force: on the line of centres, divided by the radii of discs of the
/// same areas; below the grain for a wall; for a side the nearest point of it.
void put_geometry(const grains::State& state, Force& force) {
  const grains::Particle& upper = state.particles[force.upper];
  const lattice::Shape& shape = state.shape(upper);
  const Eigen::Vector2d centre = grains::centre_in_box(state, upper);
  if (is_side(force.other)) {
    const Eigen::Vector2d low = lattice::Lattice::lower_left_corner();
    const Eigen::Vector2d high = low + state.lattice.extent();
    const bool is_level = force.other == kFloor || force.other == kCeiling;
    const bool is_low = force.other == kFloor || force.other == kLeftSide;
    force.point = centre;
    force.point[is_level ? 1 : 0] = (is_low ? low : high)[is_level ? 1 : 0];
    force.branch = centre - force.point;
    return;
  }
  if (!grains::is_particle(force.other)) {
    force.branch = shape.diameter() / 2 * force.normal;
    force.point = state.lattice.image_in_box(centre - force.branch);
    return;
  }
  const grains::Particle& other = state.particles[grains::particle_id(force.other)];
  const lattice::Shape& other_shape = state.shape(other);
  force.branch = shape.centroid() - other_shape.centroid() -
                 lattice::position(state.lattice.shortest_vector(upper.site(), other.site()));
  const double radius = shape.diameter() / 2;
  force.point = state.lattice.image_in_box(centre - radius / (radius + other_shape.diameter() / 2) *
                                                        force.branch);
}

using Sum = ForceSums::Sum;

std::uint64_t key(const Sum& sum) {
  const auto [first, second] = sorted_bodies(sum.upper, sum.other);
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(first)) << 32U) |
         static_cast<std::uint32_t>(second);
}

Sum sum_of(const Force& force) {
  return {.upper = force.upper,
          .other = force.other,
          .point = force.point,
          .normal = force.normal,
          .branch = force.branch,
          .force = force.on_upper(),
          .touching_steps = force.share};
}

void add_sum(ForceSums& sums, Sum later) {
  const auto [found, is_new] = sums.index_by_bodies.try_emplace(key(later), sums.sums.size());
  if (is_new) {
    sums.sums.push_back(later);
    return;
  }
  Sum& sum = sums.sums[found->second];
  later.force += (sum.upper == later.upper ? 1.0 : -1.0) * sum.force;
  later.touching_steps += sum.touching_steps;
  sum = later;
}

/// Rebuilds the index of sums that were loaded.
void rebuild_index(ForceSums& sums) {
  if (sums.index_by_bodies.empty()) {
    for (std::size_t i = 0; i < sums.sums.size(); ++i) {
      sums.index_by_bodies.emplace(key(sums.sums[i]), i);
    }
  }
}

}  // namespace

std::vector<double> normal_loads(std::size_t grain_count, const std::vector<Force>& forces) {
  std::vector<double> sums(grain_count, 0);
  for (const Force& force : forces) {
    sums[force.upper] += force.normal_force;
    if (grains::is_particle(force.other)) {
      sums[grains::particle_id(force.other)] += force.normal_force;
    }
  }
  return sums;
}

double mean_grain_mass(const grains::State& state) {
  double sum = 0;
  double count = 0;
  for (const grains::Particle& grain : state.particles) {
    if (grain.present) {
      sum += static_cast<double>(state.shape(grain).size());
      count += 1;
    }
  }
  return count > 0 ? sum / count : 1;
}

std::vector<Force> forces(const State& state, double gravity) {
  return forces(state.grains, state.contacts, gravity);
}

std::vector<Force> forces(const grains::State& grains, std::span<const Contact> contacts,
                          double gravity) {
  std::vector<Force> result;
  result.reserve(contacts.size());
  const double weight = mean_grain_mass(grains) / mass_unit(grains.kinds) * gravity * kSpacing;
  for (const Contact& contact : contacts) {
    Force& force = result.emplace_back();
    force.upper = contact.upper;
    force.other = contact.other;
    force.normal = as_double(contact.normal);
    force.normal_force = (contact.impulse.normal + contact.transient.normal) / weight;
    force.shear_force = (contact.impulse.shear + contact.transient.shear) / weight;
    put_geometry(grains, force);
  }
  return result;
}

void set_mean_mass(ForceSums& sums, double mean_mass) {
  if (sums.mean_mass != mean_mass) {
    for (Sum& sum : sums.sums) {
      sum.force *= sums.mean_mass / mean_mass;
    }
    sums.mean_mass = mean_mass;
  }
}

void add(ForceSums& sums, std::span<const Force> forces_of_a_step, double mean_mass) {
  rebuild_index(sums);
  set_mean_mass(sums, mean_mass);
  for (const Force& force : forces_of_a_step) {
    add_sum(sums, sum_of(force));
  }
  ++sums.steps;
}

void add(ForceSums& sums, const ForceSums& later) {
  if (later.steps == 0) {
    return;
  }
  rebuild_index(sums);
  set_mean_mass(sums, later.mean_mass);
  for (const Sum& sum : later.sums) {
    add_sum(sums, sum);
  }
  sums.steps += later.steps;
}

std::vector<Force> mean_forces(const ForceSums& sums) {
  std::vector<Sum> sorted = sums.sums;
  std::ranges::sort(sorted, {}, [](const Sum& sum) { return sorted_bodies(sum.upper, sum.other); });
  std::vector<Force> result;
  result.reserve(sorted.size());
  for (const Sum& sum : sorted) {
    const Eigen::Vector2d mean = sum.force / static_cast<double>(sums.steps);
    result.push_back({.upper = sum.upper,
                      .other = sum.other,
                      .point = sum.point,
                      .normal = sum.normal,
                      .branch = sum.branch,
                      .normal_force = mean.dot(sum.normal),
                      .shear_force = mean.dot(Eigen::Vector2d(-sum.normal.y(), sum.normal.x())),
                      .share = sum.touching_steps / static_cast<double>(sums.steps)});
  }
  return result;
}

std::vector<double> force_residuals(const grains::State& state, const std::vector<Force>& forces,
                                    const Eigen::Vector2d& down) {
  const double mean = mean_grain_mass(state);
  std::vector<Eigen::Vector2d> sums(state.particles.size(), Eigen::Vector2d::Zero());
  for (const Force& force : forces) {
    sums[force.upper] += force.on_upper();
    if (grains::is_particle(force.other)) {
      sums[grains::particle_id(force.other)] -= force.on_upper();
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
