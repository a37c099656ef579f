#include "run/contact_tables.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "clca/measure/force_distribution.hpp"
#include "clca/measure/stress.hpp"
#include "clca/run/quantity.hpp"
#include "clca/store/table.hpp"

namespace clca::run {

// No wall has a dot in its name, so none is called as a side of the box.
std::string body_name(const scene::Scene& scene, grains::Owner owner) {
  switch (owner) {
    case contact::kFloor:
      return "box.floor";
    case contact::kCeiling:
      return "box.top";
    case contact::kLeftSide:
      return "box.left";
    case contact::kRightSide:
      return "box.right";
    default:
      return grains::is_particle(owner) ? fmt::format("{}", owner)
                                        : scene.walls[grains::wall_number(owner)].name;
  }
}

namespace {

using Forces = std::vector<contact::Force>;

/// Number of contacts and sum of normal forces of a grain.
struct GrainLoad {
  std::uint64_t contacts = 0;
  double normal = 0;
};

std::vector<GrainLoad> loads(const grains::State& state, const Forces& forces) {
  std::vector<GrainLoad> result(state.particles.size());
  const auto add = [&](std::size_t id, const contact::Force& force) {
    ++result[id].contacts;
    result[id].normal += force.along_normal;
  };
  for (const contact::Force& force : forces) {
    add(force.upper, force);
    if (grains::is_particle(force.other)) {
      add(static_cast<std::size_t>(force.other), force);
    }
  }
  return result;
}

}  // namespace

std::optional<measure::ForceDistribution> distribution(const Forces& forces) {
  std::vector<double> strengths;
  for (const contact::Force& force : forces) {
    if (grains::is_particle(force.other) && force.along_normal > 0) {
      strengths.push_back(force.along_normal);
    }
  }
  return measure::force_distribution(strengths, measure::Strength::averaged);
}

std::string contact_forces_csv(const scene::Scene& scene, const Forces& forces) {
  store::Table table(
      {"first", "second", "x", "y", "normal_x", "normal_y", "normal_force", "shear_force"});
  for (const contact::Force& force : forces) {
    table.add_row({std::uint64_t{force.upper}, body_name(scene, force.other), force.point.x(),
                   force.point.y(), force.normal.x(), force.normal.y(), force.along_normal,
                   force.along_shear});
  }
  return table.to_csv();
}

std::string force_distribution_csv(const Forces& forces) {
  store::Table table({"low", "high", "count", "density"});
  if (const auto all = distribution(forces)) {
    for (const measure::ForceBin& bin : all->bins) {
      table.add_row({bin.low, bin.high, std::uint64_t{bin.count}, bin.density});
    }
  }
  return table.to_csv();
}

std::string grain_loads_csv(const scene::Scene& scene, const Model& model, const Forces& forces) {
  const grains::State& state = model.state();
  const std::vector<GrainLoad> all = loads(state, forces);
  const std::vector<double> residuals =
      contact::residuals(state, forces, gravity_direction(model.vessel()));
  store::Table table({"id", "species", "x", "y", "contacts", "normal_force", "residual"});
  for (std::size_t id = 0; id < all.size(); ++id) {
    const grains::Particle& grain = state.particles[id];
    if (grain.present) {
      const Eigen::Vector2d centre = grains::centre_in_box(state, grain);
      table.add_row({std::uint64_t{id}, scene.species[state.kinds[grain.kind].species].name,
                     centre.x(), centre.y(), all[id].contacts, all[id].normal, residuals[id]});
    }
  }
  return table.to_csv();
}

std::string wall_forces_csv(const scene::Scene& scene, const Forces& forces) {
  struct Sum {
    std::uint64_t contacts = 0;
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
  };
  std::map<grains::Owner, Sum> sums;
  for (const grains::Owner side :
       {contact::kFloor, contact::kCeiling, contact::kLeftSide, contact::kRightSide}) {
    sums[side] = {};
  }
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    sums[grains::wall_code(wall)] = {};
  }
  for (const contact::Force& force : forces) {
    if (!grains::is_particle(force.other)) {
      Sum& sum = sums[force.other];
      ++sum.contacts;
      sum.force -= force.on_upper();
    }
  }
  store::Table table({"wall", "contacts", "force_x", "force_y"});
  for (const auto& [owner, sum] : sums) {
    table.add_row({body_name(scene, owner), sum.contacts, sum.force.x(), sum.force.y()});
  }
  return table.to_csv();
}

std::string stress_csv(const grains::State& state, const Forces& forces, double cell) {
  store::Table table({"x", "y", "xx", "xy", "yy", "pressure"});
  for (const measure::StressCell& one : measure::stress_field(state, forces, cell)) {
    if (one.xx != 0 || one.xy != 0 || one.yy != 0) {
      table.add_row({one.centre.x(), one.centre.y(), one.xx, one.xy, one.yy, one.pressure()});
    }
  }
  return table.to_csv();
}

}  // namespace clca::run
