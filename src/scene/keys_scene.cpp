// The keys at the top, of both kinds of scenes.

#include <fmt/ranges.h>

#include <limits>
#include <string>
#include <vector>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

/// What both kinds begin with. What stands under `let` is evaluated before the keys are read; the
/// scene has the numbers.
template <class AScene>
Keys<AScene> first_keys() {
  static const std::string kVersionText = std::to_string(kVersion);
  const auto check_version = [](const KeyedMap& fields, AScene& /*scene*/) {
    const Place place = fields.at("clca");
    if (place.value.quoted || place.value.text != kVersionText) {
      fail(place, "expected version {} of the format, found {}", kVersionText, found(place));
    }
  };
  return {
      own_key<AScene>({.name = "clca",
                       .about = "version of the format, without quotes",
                       .allowed = fmt::format("`{}`", kVersionText),
                       .required = true,
                       .schema = fmt::format(R"({{"const": {}}})", kVersionText)},
                      check_version)
          .written_as(
              [](const AScene& /*scene*/) { return std::optional(Value::scalar(kVersionText)); }),
      own_key<AScene>(
          {.name = "let",
           .about = "numbers with names, for [expressions](#expressions) in the place of numbers",
           .allowed = "numbers by name",
           .otherwise = "none",
           .schema = object_schema(R"({"type": "number"})", kExpressionNamePattern)}),
      key("title", &AScene::title, title_type(), "one line for captions, figures and reports")
          .defaults_to("name of the file"),
      key("seed", &AScene::seed, count(0, std::numeric_limits<std::uint64_t>::max()),
          "seed of all draws: the same scene and seed give the same run, bit for bit")};
}

Keys<Scene> scene_keys() {
  Keys<Scene> keys = first_keys<Scene>();
  keys.add({key("model", &Scene::model, choice(kModelNames),
                "what moves the grains: rules, velocities and the friction of contacts, voids that "
                "rise, or energies of velocities and axes; [model](#model)"),
            key("begin", &Scene::begin, begin_type(),
                "the state of another run that this one begins with: [begin](#begin)")
                .defaults_to("an empty box"),
            required("box", &Scene::box, box_type(), "the [box](#box) that everything happens in"),
            required("species", &Scene::species, species_type(),
                     "kinds of particles, by name: [species](#species)")});
  keys.add(model_blocks());
  keys.add({list_key("walls", &Scene::walls, walls_type(),
                     "obstacles, standing or moving, by name: [walls](#walls)"),
            list_key("sources", &Scene::sources, sources_type(),
                     "points and regions that emit particles, by name: [sources](#sources)"),
            list_key("outlets", &Scene::outlets, outlets_type(),
                     "regions that remove and count particles, by name: [outlets](#outlets)"),
            list_key("probes", &Scene::probes, probes_type(),
                     "regions of the box that are observed, by name: [probes](#probes)"),
            list_key("lines", &Scene::lines, lines_type(),
                     "lines across which flux and velocity are measured, by name: [lines](#lines)"),
            required("stages", &Scene::stages, stages_type(),
                     "what happens, one after the other: [stages](#stages)"),
            measure_key(),
            key("output", &Scene::output, output_type(),
                "pictures, tables, trajectory and checkpoints: [output](#output)")
                .defaults_to("that of each of its keys")});
  return keys;
}

/// A key of one model goes with that alone; without `model` it is the automaton.
std::string model_conditions() {
  std::vector<std::string> conditions;
  for (const AnyKey& key : scene_keys()) {
    if (key.model) {
      conditions.push_back(
          fmt::format(R"("{}": {{{}"properties": {{"model": {{"const": "{}"}}}}}})", key.name,
                      *key.model == Model::automaton ? "" : R"("required": ["model"], )",
                      name_of(kModelNames, *key.model)));
    }
  }
  return fmt::format(R"("dependencies": {{{}}})", fmt::join(conditions, ", "));
}

}  // namespace

const Type<Scene>& scene_type() {
  static const std::string kConditions = model_conditions();
  static const Type<Scene> kType =
      type_of<Scene>({.keys = scene_keys(), .conditions = kConditions});
  return kType;
}

const Type<BoltzmannScene>& boltzmann_type() {
  static const Type<BoltzmannScene> kType = [] {
    Keys<BoltzmannScene> keys = first_keys<BoltzmannScene>();
    keys.add({boltzmann_block(), boltzmann_output()});
    return type_of<BoltzmannScene>({.keys = keys});
  }();
  return kType;
}

}  // namespace clca::scene
