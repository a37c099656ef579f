#pragma once
// One step of lattice contact dynamics: the definition of the model.

#include <cstdint>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/bodies.hpp"
#include "contact/rule/contact_law.hpp"
#include "contact/rule/normal_table.hpp"
#include "grains/internal/footprint.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "grains/internal/wall_step.hpp"

namespace clca::contact {

/// Constants of a run, as integers. Ratios in 2^-16.
struct Rule {
  std::int32_t gravity = 0;  ///< in 2^-23 lattice spacings per step squared
  std::int32_t restitution = 0;
  int sweeps = 2;
  std::int32_t friction = 0;                     ///< between grains
  std::int32_t side_friction = 0;                ///< of the sides of the box
  std::vector<std::int32_t> wall_friction = {};  ///< by wall
  LawConstants law = {};
  Bodies bodies;

  std::int32_t friction_with(grains::Owner other) const {
    if (grains::is_particle(other)) {
      return friction;
    }
    return is_side(other) ? side_friction : wall_friction[grains::wall_number(other)];
  }
};

/// Speed below which a grain counts as resting: twice what gravity gives in a step.
inline std::int32_t slow_speed(const Rule& rule) {
  return 2 * rule.gravity;
}

/// Whether this step sorts the contacts anew.
inline bool sorts_contacts(const State& state) {
  constexpr std::uint64_t kEvery = 8;
  return state.changed || state.grains.step % kEvery == 0;
}

/// One step without sources and outlets. Returns the ids of moved grains, without duplicates.
std::vector<std::uint32_t> reference_step(State& state, grains::OccupancyTable& occupancy,
                                          const grains::FootprintTable& footprints,
                                          const grains::WallEdges& edges, const Rule& rule,
                                          NormalTable& normals);

}  // namespace clca::contact
