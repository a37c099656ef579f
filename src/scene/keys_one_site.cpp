// The void model, and that of Baxter & Behringer.

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

Type<voids::Rules> voids_type() {
  return type_of<voids::Rules>(
      {.keys = {key("straight", &voids::Rules::straight, number(0, 1),
                    "weight of the grain straight above a void; the two beside it share the "
                    "rest: 1/3 is equal chances")}});
}

Type<baxter::Rules> baxter_type() {
  using baxter::Rules;
  return type_of<Rules>(
      {.keys = {key("power", &Rules::power, integer(0, baxter::kMaxPower),
                    "α: power of the energy of neighbours with unlike velocities"),
                key("gravity", &Rules::gravity, number(0, baxter::kMaxGravity),
                    "E_G: energy of a grain that does not go down where it can"),
                key("like_axes", &Rules::like_axes, number(0, 1),
                    "s: factor of the energy of neighbours with equal axes; with 1, axes do not "
                    "matter (β = 0)")}});
}

}  // namespace clca::scene
