// The blocks that belong to one model each, and those of the models of grains of one site.

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

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

}  // namespace

Keys<Scene> model_blocks() {
  return {
      key("rules", &Scene::rules, rules_type(), "what a particle does in a step: [rules](#rules)")
          .of(Model::automaton)
          .defaults_to("that of each of its keys"),
      key("contact", &Scene::contact, contact_type(),
          "what particles do to each other where they touch: [contact](#contact)")
          .of(Model::contact)
          .defaults_to("that of each of its keys"),
      key("voids", &Scene::voids, voids_type(), "which grains rising voids take: [voids](#voids)")
          .of(Model::voids)
          .defaults_to("that of each of its keys"),
      key("baxter", &Scene::baxter, baxter_type(),
          "which velocities and axes grains choose: [baxter](#baxter)")
          .of(Model::baxter)
          .defaults_to("that of each of its keys"),
      key("units", &Scene::units, units_type(),
          "the length of a lattice spacing, gravity: [units](#units)")
          .of(Model::contact)
          .defaults_to("none")};
}

}  // namespace clca::scene
