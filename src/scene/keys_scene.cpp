// The keys at the top, of both kinds of scenes; title, box, initial state from another run.

#include <fmt/ranges.h>

#include "clca/text/read.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxLineLength = 200;

std::string read_text_line(const PlacedValue& place) {
  const std::string& line = read_text(place);
  const std::optional<std::size_t> characters = line_length(line);
  if (!characters) {
    fail(place, "expected one line of text, found {}", text::quoted(line));
  }
  if (*characters == 0 || *characters > kMaxLineLength) {
    fail(place, "expected 1 to {} characters, found {}", kMaxLineLength, *characters);
  }
  return line;
}

constexpr std::size_t kHashDigits = 16;

std::uint64_t read_hash(const PlacedValue& place) {
  constexpr int kHexadecimal = 16;
  const std::string& digits = read_text(place);
  const auto hash = text::number<std::uint64_t>(digits, kHexadecimal);
  if (digits.size() != kHashDigits || !hash) {
    fail(place, "expected {} hexadecimal digits, found {}", kHashDigits, found(place));
  }
  return *hash;
}

Type<std::uint64_t> hash_type() {
  return custom_type<std::uint64_t>(
      fmt::format("{} hexadecimal digits, in quotes", kHashDigits),
      text_schema("^[0-9A-Fa-f]{16}$"), read_hash,
      [](std::uint64_t hash) { return Value::quoted_text(fmt::format("{:016x}", hash)); });
}

Type<Box> box_type() {
  return type_of<Box>(
      {.keys =
           {required_key("width", &Box::width,
                         length_type(number_type(1, 866'025)),  // at most 1,000,000 columns
                         "width; columns stand 0.866 apart"),
            required_key("height", &Box::height, length_type(number_type(1, kMaxBoxHeight)),
                         "height"),
            key("periodic", &Box::periodic, bool_type(),
                "what leaves on the right comes back on the left; the number of columns is made "
                "even")},
       .check = [](const PlacedValue& fields, Box& box) { box.location = location_text(fields); }});
}

Type<InitialState> begin_type() {
  return type_of<InitialState>(
      {.keys = {required_key("run", &InitialState::run_folder, file_path_type(),
                             "folder of the run; a relative one begins at the folder of the scene"),
                key("step", &InitialState::step,
                    word_or_value("last", count_type(0, kMaxSteps),
                                  fmt::format("a whole number from 0 to {}", kMaxSteps)),
                    "its end, or a step of its trajectory"),
                key("state", &InitialState::state_hash, hash_type(),
                    "expected hash of that state; any other is refused. A run records it in its "
                    "`scene.yaml`")
                    .defaults_to("any state")},
       .check = [](const PlacedValue& fields, InitialState& begin) {
         begin.location = location_text(fields);
       }});
}

/// First keys of both kinds of scenes. `let` is evaluated before: the scene has only the numbers.
template <class AScene>
Keys<AScene> first_keys() {
  static const std::string kVersionText = std::to_string(kVersion);
  const auto check_version = [](const PlacedValue& fields, AScene& /*scene*/) {
    const PlacedValue place = fields.at("clca");
    if (place.value.quoted || place.value.text != kVersionText) {
      fail(place, "expected version {} of the format, found {}", kVersionText, found(place));
    }
  };
  return {
      custom_key<AScene>("clca",
                         {.allowed = fmt::format("`{}`", kVersionText),
                          .schema = fmt::format(R"({{"const": {}}})", kVersionText)},
                         "version of the format, without quotes", check_version)
          .mark_required()
          .written_as(
              [](const AScene& /*scene*/) { return std::optional(Value::scalar(kVersionText)); }),
      custom_key<AScene>(
          "let",
          {.allowed = "numbers by name",
           .schema = object_schema(R"({"type": "number"})", kExpressionNamePattern)},
          "numbers with names, for [expressions](#expressions) in the place of numbers")
          .defaults_to("none"),
      key("title", &AScene::title, text_line_type(), "one line for captions, figures and reports")
          .defaults_to("name of the file"),
      key("seed", &AScene::seed, count_type(0, std::numeric_limits<std::uint64_t>::max()),
          "seed of all draws: the same scene and seed give the same run, bit for bit")};
}

Keys<Scene> scene_keys() {
  Keys<Scene> keys = first_keys<Scene>();
  keys.add(
      {key("model", &Scene::model, choice_type(kModelNames),
           "what moves the grains: rules, velocities and the friction of contacts, voids that "
           "rise, or energies of velocities and axes; [model](#model)"),
       key("begin", &Scene::initial_state, begin_type(),
           "the state of another run that this one begins with: [begin](#begin)")
           .defaults_to("an empty box"),
       required_key("box", &Scene::box, box_type(), "the [box](#box) that everything happens in"),
       required_key("species", &Scene::species, species_type(),
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
            required_key("stages", &Scene::stages, stages_type(),
                         "what happens, one after the other: [stages](#stages)"),
            measure_key(),
            key("output", &Scene::output, output_type(),
                "pictures, tables, trajectory and checkpoints: [output](#output)")
                .defaults_to("that of each of its keys")});
  return keys;
}

/// A key of one model goes with that alone; without `model` it is the automaton.
std::string model_schema_members() {
  std::vector<std::string> dependencies;
  for (const AnyKey& key : scene_keys()) {
    if (key.model) {
      dependencies.push_back(
          fmt::format(R"("{}": {{{}"properties": {{"model": {{"const": "{}"}}}}}})", key.name,
                      *key.model == Model::automaton ? "" : R"("required": ["model"], )",
                      name_of(kModelNames, *key.model)));
    }
  }
  return fmt::format(R"("dependencies": {{{}}})", fmt::join(dependencies, ", "));
}

}  // namespace

Type<std::string> text_line_type() {
  return custom_type<std::string>(
      fmt::format("1 to {} characters", kMaxLineLength),
      fmt::format(R"({{"type": ["string", "number", "boolean"], "minLength": 1, "maxLength": {}}})",
                  kMaxLineLength),
      read_text_line, [](const std::string& line) { return Value::quoted_text(line); });
}

const Type<Scene>& scene_type() {
  static const std::string kSchemaMembers = model_schema_members();
  static const Type<Scene> kType =
      type_of<Scene>({.keys = scene_keys(), .schema_members = kSchemaMembers});
  return kType;
}

const Type<BoltzmannScene>& boltzmann_type() {
  static const Type<BoltzmannScene> kType = [] {
    Keys<BoltzmannScene> keys = first_keys<BoltzmannScene>();
    keys.add({boltzmann_block_key(), boltzmann_output_key()});
    return type_of<BoltzmannScene>({.keys = keys});
  }();
  return kType;
}

}  // namespace clca::scene
