#pragma once
// Contact forces: impulses divided by time, of the last step or averaged over several.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// The force between a grain and another body, in weights of a grain of mean mass.
struct Force {
  std::uint32_t upper = 0;                           ///< id, see Contact::upper
  grains::Owner other = 0;                           ///< a grain, a wall or a side of the box
  Eigen::Vector2d point = Eigen::Vector2d::Zero();   ///< of contact, in the box, lattice spacings
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< of length 1, towards the upper grain
  /// From the centre of the other grain, or the contact point with a wall or side, to the upper
  /// centre. That with a wall is on a disc of the grain's area, that with a side on the side.
  Eigen::Vector2d branch = Eigen::Vector2d::Zero();
  double normal_force = 0;  ///< not negative in one step
  double shear_force = 0;   ///< on the normal turned anticlockwise
  double share = 1;         ///< of the steps, in which the two touched

  bool operator==(const Force&) const = default;

  /// Force on the upper grain; the other body has the opposite force.
  Eigen::Vector2d on_upper() const {
    return normal_force * normal + shear_force * Eigen::Vector2d(-normal.y(), normal.x());
  }
};

/// Forces of all contacts, in their order. `gravity` in lattice spacings per step squared.
std::vector<Force> forces(const State& state, double gravity);
/// Forces of these contacts of the grains, in the order of the contacts.
std::vector<Force> forces(const grains::State& grains, std::span<const Contact> contacts,
                          double gravity);

/// Sums of the forces of several steps, by contact.
struct ForceSums {
  /// Bytes for so many contacts.
  static double bytes_for(double contacts) {
    constexpr double kNode = sizeof(decltype(index_by_bodies)::value_type) + 4 * sizeof(void*);
    return contacts * (grains::kListCapacityRatio * sizeof(Sum) + kNode);
  }

  struct Sum {
    std::uint32_t upper = 0;
    grains::Owner other = 0;
    // As in Force, at the last step in which they touched.
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
    Eigen::Vector2d branch = Eigen::Vector2d::Zero();
    /// Sum over all steps of the force on the upper grain.
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    double touching_steps = 0;

    bool operator==(const Sum&) const = default;
    CLCA_FIELDS(upper, other, point, normal, branch, force, touching_steps);
  };
  std::vector<Sum> sums = {};  ///< two bodies have one
  std::uint64_t steps = 0;
  double mean_mass = 0;  ///< whose weight is the unit of the forces, in sites
  /// Index in `sums`, by the two bodies.
  std::unordered_map<std::uint64_t, std::size_t> index_by_bodies = {};

  CLCA_FIELDS(sums, steps, mean_mass);
};

/// Converts the sums to weights of a grain of this mass.
void set_mean_mass(ForceSums& sums, double mean_mass);

/// Adds forces of later steps; the sums are in the same unit then. `mean_mass`: of the grains in
/// the step.
void add(ForceSums& sums, std::span<const Force> forces_of_a_step, double mean_mass);
void add(ForceSums& sums, const ForceSums& later);

/// Mean forces over the steps, including those without contact: the mean vector, resolved along the
/// last normal. Sorted by ids, the smaller one first. Empty if there are no steps.
std::vector<Force> mean_forces(const ForceSums& sums);

/// Sum of normal forces on each grain, by id.
std::vector<double> normal_loads(std::size_t grain_count, const std::vector<Force>& forces);

/// Mean mass of the present grains, in sites; 1 if there are none: the forces of a step after which
/// the box is empty are in weights of a site.
double mean_grain_mass(const grains::State& state);

/// Residual of the force balance of each grain, divided by its weight, by id; 0 for removed grains.
/// `down`: unit vector, direction of gravity.
std::vector<double> force_residuals(const grains::State& state, const std::vector<Force>& forces,
                                    const Eigen::Vector2d& down);

}  // namespace clca::contact
