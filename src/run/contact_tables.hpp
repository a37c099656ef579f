#pragma once
// Force tables of a stage of the contact model. Forces are in weights of a grain of mean mass.

#include <optional>
#include <string>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/force_distribution.hpp"
#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

/// Of the normal forces between grains; none without any.
std::optional<measure::ForceDistribution> distribution(const std::vector<contact::Force>& forces);

/// Columns: first, second (grain ids, the upper one first; the name of a wall, or floor, ceiling,
/// left, right of the box), x, y (place), normal_x, normal_y (towards the first), normal_force,
/// shear_force.
std::string contact_forces_csv(const scene::Scene& scene,
                               const std::vector<contact::Force>& forces);

/// Columns: low, high (force), count, density (of f/<f>): of the normal forces between grains.
std::string force_distribution_csv(const std::vector<contact::Force>& forces);

/// Columns: id, species, x, y (centre of mass), contacts, normal_force (sum over its contacts),
/// residual (what forces and weight do not balance, over the weight), by grain.
std::string grain_loads_csv(const scene::Scene& scene, const Model& model,
                            const std::vector<contact::Force>& forces);

/// Columns: wall, contacts, force_x, force_y (on the wall), for each wall and side of the box.
std::string wall_forces_csv(const scene::Scene& scene, const std::vector<contact::Force>& forces);

/// Columns: x, y (centre of a cell), xx, xy, yy, pressure (grain weights per spacing), by cell of a
/// measure::Grid of side `cell`; cells without stress are left out.
std::string stress_csv(const grains::State& state, const std::vector<contact::Force>& forces,
                       double cell);

}  // namespace clca::run
