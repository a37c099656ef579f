// The keys at the top, of both kinds of scenes.

#include <limits>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

std::vector<Measure> all_measures() {
  std::vector<Measure> measures;
  for (const auto& named : kMeasureNames) {
    measures.push_back(named.value);
  }
  return measures;
}

template <class AScene>
Key<AScene> version_key() {
  Key<AScene> key;
  key.name = "clca";
  key.about = "version of the format, without quotes";
  key.allowed = fmt::format("`{}`", kVersion);
  key.required = true;
  key.schema = [=] { return Json{{"const", kVersion}}; };
  key.read = [](const KeyedMap& fields, AScene& /*scene*/, const Scene& /*grains*/) {
    const Value& version = fields.at("clca");
    if (!version.is(Value::Kind::scalar) || version.quoted ||
        version.text != std::to_string(kVersion)) {
      fail(version.location, fmt::format("clca: expected version {} of the format, found {}",
                                         kVersion, found(version)));
    }
  };
  key.text = [](const AScene& /*scene*/, const Scene& /*grains*/) {
    return std::optional(Yaml::scalar(std::to_string(kVersion)));
  };
  return key;
}

/// Evaluated before the keys are read; the scene has the numbers.
template <class AScene>
Key<AScene> let_key() {
  Key<AScene> key;
  key.name = "let";
  key.about = "numbers with names, for [expressions](#expressions) in the place of numbers";
  key.allowed = "numbers by name";
  key.otherwise = "none";
  key.schema = [] {
    return Json{{"type", "object"},
                {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}}},
                {"additionalProperties", {{"type", "number"}}}};
  };
  key.read = [](const KeyedMap& /*fields*/, AScene& /*scene*/, const Scene& /*grains*/) {};
  key.text = [](const AScene& /*scene*/, const Scene& /*grains*/) { return std::nullopt; };
  return key;
}

/// What both kinds begin with.
template <class AScene>
Keys<AScene> first_keys() {
  return {version_key<AScene>(), let_key<AScene>(),
          key("title", &AScene::title, title_type(), "one line for captions, figures and reports")
              .defaults_to("name of the file"),
          key("seed", &AScene::seed, count(0, std::numeric_limits<std::uint64_t>::max()),
              "seed of all draws: the same scene and seed give the same run, bit for bit")};
}

Map<Scene> make_scene_map() {
  Map<Scene> map = {.keys = first_keys<Scene>()};
  map.start.measures = all_measures();
  map.start.output.checkpoint = kDefaultCheckpoints;
  auto measure = key("measure", &Scene::measures, measures_type(),
                     "what is measured at the end of each stage: [measures](#measures)")
                     .defaults_to("all");
  measure.read = [read = measure.read](const KeyedMap& fields, Scene& scene, const Scene& same) {
    if (scene.contact.sleeping) {
      std::erase(scene.measures, Measure::force);
    }
    read(fields, scene, same);
  };
  const Keys<Scene> more = {
      key("model", &Scene::model, choice(kModelNames),
          "what moves the grains: rules, or velocities and the friction of contacts; "
          "[model](#model)"),
      key("begin", &Scene::begin, begin_type(),
          "the state of another run that this one begins with: [begin](#begin)")
          .defaults_to("an empty box"),
      required("box", &Scene::box, box_type(), "the [box](#box) that everything happens in"),
      required("species", &Scene::species, species_type(),
               "kinds of particles, by name: [species](#species)"),
      key("rules", &Scene::rules, rules_type(), "what a particle does in a step: [rules](#rules)")
          .of(Model::automaton)
          .defaults_to("see there"),
      key("contact", &Scene::contact, contact_type(),
          "what particles do to each other where they touch: [contact](#contact)")
          .of(Model::contact)
          .defaults_to("see there"),
      key("units", &Scene::units, units_type(),
          "the length of a lattice spacing, gravity: [units](#units)")
          .of(Model::contact)
          .defaults_to("none"),
      list_key("walls", &Scene::walls, walls_type(),
               "obstacles, standing or moving, by name: [walls](#walls)"),
      list_key("sources", &Scene::sources, sources_type(),
               "places that emit particles, by name: [sources](#sources)"),
      list_key("outlets", &Scene::outlets, outlets_type(),
               "regions that remove and count particles, by name: [outlets](#outlets)"),
      list_key("probes", &Scene::probes, probes_type(),
               "regions of the box that are observed, by name: [probes](#probes)"),
      list_key("lines", &Scene::lines, lines_type(),
               "lines across which flux and velocity are measured, by name: [lines](#lines)"),
      required("stages", &Scene::stages, stages_type(),
               "what happens, one after the other: [stages](#stages)"),
      measure,
      key("output", &Scene::output, output_type(),
          "pictures, tables, trajectory and checkpoints: [output](#output)", map.start.output)
          .defaults_to("see there")};
  map.keys.insert(map.keys.end(), more.begin(), more.end());
  map.conditions = [] {
    const Json of_contact = {{"required", {"model"}},
                             {"properties", {{"model", {{"const", "contact"}}}}}};
    return Json{
        {"dependencies",
         {{"contact", of_contact}, {"units", of_contact}, {"rules", {{"not", of_contact}}}}}};
  };
  return map;
}

}  // namespace

const Map<Scene>& scene_map() {
  static const Map<Scene> kMap = make_scene_map();
  return kMap;
}

const Map<BoltzmannScene>& boltzmann_map() {
  static const Map<BoltzmannScene> kMap = [] {
    Map<BoltzmannScene> map = {.keys = first_keys<BoltzmannScene>()};
    map.keys.push_back(boltzmann_block());
    map.keys.push_back(boltzmann_output());
    map.start.checkpoint = kDefaultCheckpoints;
    return map;
  }();
  return kMap;
}

}  // namespace clca::scene
