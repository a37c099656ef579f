#include "clca/scene/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clca/text/message.hpp"
#include "clca/text/name.hpp"
#include "clca/text/read.hpp"
#include "scene/document.hpp"
#include "scene/keyed_map.hpp"
#include "scene/kind.hpp"
#include "scene/limits.hpp"
#include "scene/override.hpp"
#include "scene/sections.hpp"
#include "scene/source_text.hpp"

namespace clca::scene {

namespace {

void check_version(const KeyedMap& fields) {
  const Value& version = fields.at("clca");
  if (!version.is(Value::Kind::scalar) || version.quoted ||
      version.text != std::to_string(kVersion)) {
    fail(version.location, fmt::format("clca: expected version {} of the format, found {}",
                                       kVersion, found(version)));
  }
}

/// What the run is called, and its files.
std::string name_of_file(const std::string& file, const TextLocation& location) {
  std::string name = text::printable(std::filesystem::path(file).stem().string());
  if (name.empty()) {
    return "scene";
  }
  if (!text::is_file_name(name)) {
    fail(location,
         fmt::format("the name of the scene file also names the run, so it has up to 200 bytes and "
                     "no dot in front, found {}",
                     text::shown(name)));
  }
  return name;
}

std::vector<Measure> all_measures() {
  std::vector<Measure> measures;
  for (const auto& named : kMeasureNames) {
    measures.push_back(named.value);
  }
  return measures;
}

/// Reads what is there under `key`; leaves the default where nothing is.
template <class T, class Read, class... More>
void read_into(T& target, const KeyedMap& fields, std::string_view key, Read read,
               const More&... more) {
  if (const Value* value = fields.find(key)) {
    target = read(*value, more...);
  }
}

/// What both kinds of scenes begin with.
template <class AScene>
AScene read_head(const KeyedMap& fields, const std::string& file) {
  check_version(fields);
  AScene scene;
  scene.name = name_of_file(file, {fields.location().origin, 1, 1});
  scene.title = scene.name;
  read_into(scene.title, fields, "title", read_title);
  scene.seed = fields.count("seed", 0, std::numeric_limits<std::uint64_t>::max(), 1);
  return scene;
}

Scene read_scene(const Value& root, const std::string& file) {
  const KeyedMap fields(root, "", kSceneKeys);
  auto scene = read_head<Scene>(fields, file);
  scene.model = fields.choice("model", kModelNames, scene.model);
  scene.measures = all_measures();
  scene.box = read_box(fields.at("box"));
  scene.species = read_species(fields.at("species"), scene.box);
  read_into(scene.rules, fields, "rules", read_rules);
  read_into(scene.contact, fields, "contact", read_contact);
  read_into(scene.units, fields, "units", read_units);
  read_into(scene.walls, fields, "walls", read_walls, scene);
  check_model(scene, root);
  read_into(scene.sources, fields, "sources", read_sources, scene);
  read_into(scene.outlets, fields, "outlets", read_outlets, scene);
  scene.stages = read_stages(fields.at("stages"), scene);
  check_history(scene, fields.at("stages"));
  check_time_step(scene, root);
  count_steps(scene, fields.at("stages"));
  if (scene.contact.sleeping) {
    std::erase(scene.measures, Measure::force);
  }
  read_into(scene.measures, fields, "measure", read_measures);
  scene.output.checkpoint = kDefaultCheckpoints;
  read_into(scene.output, fields, "output", read_output, scene);
  check_use(scene, root);
  check_sleeping(scene, root);
  return scene;
}

BoltzmannScene read_boltzmann_scene(const Value& root, const std::string& file) {
  const KeyedMap fields(root, "", kBoltzmannSceneKeys);
  auto scene = read_head<BoltzmannScene>(fields, file);
  const auto block = std::find_if(root.entries.begin(), root.entries.end(),
                                  [](const Entry& entry) { return entry.key == "boltzmann"; });
  scene.location = to_string(block->location);
  read_boltzmann(block->value, scene);
  read_boltzmann_output(fields.find("output"), fields.at("boltzmann"), scene);
  return scene;
}

/// The scene where it is one of grains.
Scene of_grains(AnyScene any) {
  if (const auto* boltzmann = std::get_if<BoltzmannScene>(&any)) {
    throw SceneError(boltzmann->location +
                     ": error: expected a scene of grains, found one of the Boltzmann equation");
  }
  return std::get<Scene>(std::move(any));
}

std::string text_of(const std::filesystem::path& file, const TextLocation& location) {
  try {
    const auto bytes = text::read_file(file, kMaxSceneBytes);
    return {bytes.begin(), bytes.end()};
  } catch (const text::ReadError& error) {
    fail(location, fmt::format("cannot read the file: {}", error.what()));
  }
}

}  // namespace

AnyScene parse_any(std::string_view text, const std::string& file,
                   const std::vector<Override>& overrides, const std::vector<Override>& varied) {
  const auto origin = std::make_shared<const Origin>(Origin{text::printable(file), true});
  Value root = read_document(text, origin);
  if (!root.is(Value::Kind::map)) {
    fail(root.location, fmt::format("expected a scene, which begins with 'clca: {}', found {}",
                                    kVersion, found(root)));
  }
  for (const Override& text_of_override : overrides) {
    apply_override(root, text_of_override, "--set");
  }
  for (const Override& text_of_override : varied) {
    apply_override(root, text_of_override, "--vary");
  }
  if (kind_of(root) == Kind::boltzmann) {
    return read_boltzmann_scene(root, file);
  }
  return read_scene(root, file);
}

AnyScene parse_any_file(const std::filesystem::path& file, const std::vector<Override>& overrides,
                        const std::vector<Override>& varied) {
  const TextLocation start = {
      std::make_shared<const Origin>(Origin{text::printable(file.string()), true}), 1, 1};
  return parse_any(text_of(file, start), file.string(), overrides, varied);
}

Scene parse(std::string_view text, const std::string& file, const std::vector<Override>& overrides,
            const std::vector<Override>& varied) {
  return of_grains(parse_any(text, file, overrides, varied));
}

Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides,
                 const std::vector<Override>& varied) {
  return of_grains(parse_any_file(file, overrides, varied));
}

}  // namespace clca::scene
