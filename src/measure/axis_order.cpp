#include "clca/measure/axis_order.hpp"

#include "clca/baxter/baxter_model.hpp"
#include "clca/grains/occupancy.hpp"

namespace clca::measure {

std::optional<double> axis_order(const grains::State& state) {
  using lattice::Direction;
  const grains::Occupancy occupancy(state);
  double pairs = 0;
  double equal = 0;
  for (const grains::Particle& grain : state.particles) {
    if (!grain.present) {
      continue;
    }
    for (const Direction direction : {Direction::up, Direction::up_right, Direction::down_right}) {
      const grains::Owner owner =
          occupancy.owner(state.lattice.index(grain.site() + unit(direction)));
      if (grains::is_particle(owner)) {
        const auto& neighbour = state.particles[grains::particle_id(owner)];
        pairs += 1;
        equal += baxter::axis_of(grain) == baxter::axis_of(neighbour) ? 1 : 0;
      }
    }
  }
  return pairs > 0 ? std::optional(equal / pairs) : std::nullopt;
}

}  // namespace clca::measure
