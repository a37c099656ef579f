// The block of keys of each model, and the units of the contact model.

#include "clca/scene/units.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMaxFallHeight = 1e6;
constexpr double kMinSpacing = 1e-9;  // metres
constexpr double kMaxSpacing = 1e3;   // metres

using Priority = std::array<automaton::UpdateClass, 3>;

Type<Priority> priority_type() {
  const auto list = set_type(choice_type(kUpdateClassNames), 3, 3, found, "; name each class once");
  return converted<Priority>(
      "`rest`, `inertia`, `gravity`, each once", list,
      [](const std::vector<automaton::UpdateClass>& order) {
        return Priority{order[0], order[1], order[2]};
      },
      [](const Priority& order) { return std::vector(order.begin(), order.end()); });
}

Keys<automaton::Rules> rules_keys() {
  using automaton::Rules;
  return {key("inertia", &Rules::inertia, number_type(0, 1),
              "probability to keep the direction of the last step, if free"),
          key("scatter", &Rules::scatter, number_type(0, 1),
              "probability to take any free candidate, all alike, instead"),
          key("candidates", &Rules::candidates, choice_type(kCandidateNames),
              "directions a particle may take by itself: gravity and its neighbours, or all six"),
          key("gravity", &Rules::gravity, choice_type(kDirectionNames), "direction of gravity"),
          key("update_priority", &Rules::update_priority, priority_type(),
              "who moves first: those at rest, those that keep their direction, those that fall "
              "straight"),
          key("ties", &Rules::ties, choice_type(kTiesNames),
              "order within a class: by a draw for each particle, or for each direction")};
}

double read_spacing(const PlacedValue& place) {
  const std::optional<double> length = metres_in(place.value.text);
  if (!length || *length < kMinSpacing || *length > kMaxSpacing) {
    fail(
        place,
        "expected a length from {} m to {} m, a number with one of the units {}, as in 1 mm, found "
        "{}",
        kMinSpacing, kMaxSpacing, fmt::join(words(kLengthUnits), ", "), found(place));
  }
  return *length;
}

Type<double> spacing() {
  return custom_type<double>(
      fmt::format("{} m to {} m: a number and `m`, `cm`, `mm` or `um`", kMinSpacing, kMaxSpacing),
      text_schema("^[0-9.][0-9.eE+-]* *(m|cm|mm|um)$"), read_spacing,
      [](double length) { return Value::scalar(fmt::format("{} m", length)); });
}

Type<int> sweeps() {
  Type<int> type = integer_type(2, 64);
  type.allowed += ", even";
  type.schema = with(type.schema, R"("multipleOf": 2)");
  return type.checked([](const int& sweeps, const PlacedValue& place) {
    if (sweeps % 2 != 0) {
      fail(place, "expected an even number, as every second sweep goes backwards, found '{}'",
           sweeps);
    }
  });
}

/// 0 for `auto`.
Type<double> fall_height() {
  const auto type = word_or_value("auto", length_type(positive_type(kMaxFallHeight)),
                                  fmt::format("a number above 0 and up to {}", kMaxFallHeight));
  return converted<double>(
      type.allowed, type, [](std::optional<double> height) { return height.value_or(0); },
      [](double height) { return height > 0 ? std::optional(height) : std::nullopt; });
}

/// What may differ from stage to stage.
Keys<contact::Parameters> stage_contact_keys() {
  using P = contact::Parameters;
  const Type<double> friction = number_type(0, contact::kMaxFriction);
  return {key("friction", &P::friction, friction,
              "between particles: greatest tangential force over normal force"),
          key("wall_friction", &P::wall_friction, friction,
              "the same at the box, and at walls without a `friction` of their own"),
          key("rolling_friction", &P::rolling_friction, friction,
              "for `rolling: resistance`: greatest moment over normal force times radius"),
          key("restitution", &P::restitution, number_type(0, 0.99),
              "normal velocity after a collision over that before")};
}

Type<contact::Parameters> contact_type() {
  using P = contact::Parameters;
  Keys<P> keys = stage_contact_keys();
  keys.insert(keys.begin() + 2,
              key("rolling", &P::rolling, choice_type(kRollingNames),
                  "how particles turn: not at all, against a moment that resists rolling, or "
                  "freely; only hexagons and discs turn"));
  keys.add(
      {key("sweeps", &P::sweeps, sweeps(),
           "sweeps over all contacts in a step, forwards and backwards in turn"),
       key("resolution", &P::resolution, number_type(0.01, 1),
           "sites a step of a particle that has fallen by `fall_height`; sets the time step, which "
           "is not adaptive"),
       key("fall_height", &P::fall_height, fall_height(),
           "height of that fall in lattice spacings; `auto`: from the fills")});
  return type_of<P>({.keys = keys});
}

Type<voids::Rules> voids_type() {
  return type_of<voids::Rules>(
      {.keys = {key("straight", &voids::Rules::straight_weight, number_type(0, 1),
                    "weight of the grain straight above a void; the two beside it share the "
                    "rest: 1/3 is equal chances")}});
}

Type<baxter::Rules> baxter_type() {
  using baxter::Rules;
  return type_of<Rules>(
      {.keys = {key("power", &Rules::exponent, integer_type(0, baxter::kMaxPower),
                    "α: power of the energy of neighbours with unlike velocities"),
                key("gravity", &Rules::gravity, number_type(0, baxter::kMaxGravity),
                    "E_G: energy of a grain that does not go down where it can"),
                key("like_axes", &Rules::like_axes_factor, number_type(0, 1),
                    "s: factor of the energy of neighbours with equal axes; with 1, axes do not "
                    "matter (β = 0)")}});
}

}  // namespace

Type<automaton::Rules> stage_rules_type() {
  return stage_map_type(&Scene::automaton_rules, rules_keys());
}

Type<Units> units_type() {
  return type_of<Units>(
      {.keys = {
           required_key("spacing", &Units::spacing, spacing(), "length of one lattice spacing"),
           key("gravity", &Units::gravity, number_type(1e-6, 1e6), "gravity in m/s²"),
           key("density", &Units::density, number_type(1e-9, 1e9),
               "mass of a square metre of grains in kg/m²: density of the material times the "
               "depth of the layer; then masses and forces are in SI units, too")
               .defaults_to("none")}});
}

Type<contact::Parameters> stage_contact_type() {
  return stage_map_type(&Scene::contact_parameters, stage_contact_keys());
}

Keys<Scene> model_blocks() {
  return {key("rules", &Scene::automaton_rules, type_of<automaton::Rules>({.keys = rules_keys()}),
              "what a particle does in a step: [rules](#rules)")
              .of(Model::automaton)
              .defaults_to("that of each of its keys"),
          key("contact", &Scene::contact_parameters, contact_type(),
              "what particles do to each other where they touch: [contact](#contact)")
              .of(Model::contact)
              .defaults_to("that of each of its keys"),
          key("voids", &Scene::voids_rules, voids_type(),
              "which grains rising voids take: [voids](#voids)")
              .of(Model::voids)
              .defaults_to("that of each of its keys"),
          key("baxter", &Scene::baxter_rules, baxter_type(),
              "which velocities and axes grains choose: [baxter](#baxter)")
              .of(Model::baxter)
              .defaults_to("that of each of its keys"),
          key("units", &Scene::units, units_type(),
              "the length of a lattice spacing, gravity: [units](#units)")
              .of(Model::contact)
              .defaults_to("none")};
}

}  // namespace clca::scene
