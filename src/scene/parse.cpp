#include "clca/scene/parse.hpp"

#include <algorithm>
#include <array>

#include "clca/text/read.hpp"
#include "scene/sections.hpp"
#include "scene/sizes.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

/// Whether the keys are of a Boltzmann scene. Throws SceneError for keys of both kinds of scenes.
bool is_boltzmann(const Value& root) {
  const std::vector<std::string_view> grain_keys = names_of(*scene_type().keys);
  const std::vector<std::string_view> boltzmann_keys = names_of(*boltzmann_type().keys);
  const auto first_of = [&](const auto& keys, const auto& other_keys) {
    return std::ranges::find_if(root.entries, [&](const Entry& entry) {
      return std::ranges::count(keys, entry.key) > std::ranges::count(other_keys, entry.key);
    });
  };
  const auto none = root.entries.end();
  const auto automaton = first_of(grain_keys, boltzmann_keys);
  const auto boltzmann = first_of(boltzmann_keys, grain_keys);
  if (automaton != none && boltzmann != none) {
    const auto [other, entry] = std::minmax(automaton, boltzmann);
    fail(entry->location,
         "'{}' does not go with '{}': a scene of the Boltzmann equation has the keys {}; one of "
         "grains has {}",
         entry->key, other->key, fmt::join(boltzmann_keys, ", "), fmt::join(grain_keys, ", "));
  }
  // A misspelt `boltzmann` makes no scene of grains.
  const auto is_misspelt = [](const Entry& entry) {
    constexpr std::array<std::string_view, 1> kBlock = {"boltzmann"};
    return text::nearest_name(entry.key, kBlock).has_value();
  };
  return boltzmann != none || (automaton == none && std::ranges::any_of(root.entries, is_misspelt));
}

/// What the run is called, and its files.
std::string name_of_file(const std::string& file, const TextLocation& location) {
  std::string name = text::printable(std::filesystem::path(file).stem().string());
  if (name.empty()) {
    return "scene";
  }
  if (!text::is_file_name(name)) {
    fail(location,
         "the name of the scene file also names the run, so it has up to 200 bytes and no dot in "
         "front, found {}",
         text::quoted(name));
  }
  return name;
}

/// Whether the path is that of a map that holds one key out of several.
bool is_choice(const std::vector<std::string>& path) {
  return path.size() == 3 &&
         ((path[0] == "stages" && (path[2] == "until" || path[2] == "vessel")) ||
          (path[0] == "species" && path[2] == "shape"));
}

/// The view of pictures stays where they are set to none, for what is drawn of the run later.
void override_with(Value& root, const Override& given, bool varies) {
  const Value* view =
      given.text.starts_with("output.frames=") ? root.find_path("output.frames.view") : nullptr;
  const std::optional<Value> kept = view != nullptr ? std::optional(*view) : std::nullopt;
  document::apply_override(root, given.text, varies ? "--vary" : "--set", given.option, is_choice,
                           varies);
  const Value* frames = root.find_path("output.frames");
  if (kept && !frames->quoted && frames->text == "none") {
    Value& output = *root.find("output");
    std::erase_if(output.entries, [](const Entry& entry) { return entry.key == "view"; });
    output.entries.push_back({"view", kept->location, *kept});
  }
}

Scene read_scene(Value root, const std::string& file) {
  Scene scene;
  if (const Value* units = root.find("units")) {  // first: lengths may be in them
    scene.units = units_type().read({*units, "units", scene});
  }
  expand_sizes(root, scene);
  scene.title = scene.name = name_of_file(file, {root.location.origin, 1, 1});
  scene.folder = std::filesystem::path(file).parent_path().string();
  const PlacedValue place = {root, "", scene};
  scene_type().read_into(place, &scene);
  const bool is_observed = !scene.probes.empty() || !scene.lines.empty();
  if (is_observed && root.find_path("output.series") == nullptr) {
    scene.output.series = SeriesOutput();  // probes and lines are observed at its steps
  }
  check_model(place);
  check_stage_order(place.at("stages"));
  check_time_step(place);
  set_max_steps(scene, *root.find("stages"));
  check_unused_items(place);
  put_numbers_into_derived(scene);
  return scene;
}

BoltzmannScene read_boltzmann_scene(const Value& root, const std::string& file) {
  BoltzmannScene scene;
  scene.title = scene.name = name_of_file(file, {root.location.origin, 1, 1});
  const Scene none;
  const PlacedValue place = {root, "", none};
  boltzmann_type().read_into(place, &scene);
  check_series_rows(place, scene);
  const auto block = std::ranges::find_if(
      root.entries, [](const Entry& entry) { return entry.key == "boltzmann"; });
  scene.location = to_string(block->location);
  return scene;
}

/// The scene where it is one of grains.
Scene scene_of_grains(AnyScene any) {
  if (const auto* boltzmann = std::get_if<BoltzmannScene>(&any)) {
    throw SceneError(boltzmann->location +
                     ": error: expected a scene of grains, found one of the Boltzmann equation");
  }
  return std::get<Scene>(std::move(any));
}

}  // namespace

AnyScene parse_any(std::string_view text, const std::string& file,
                   const std::vector<Override>& overrides, const std::vector<Override>& varied) {
  const auto origin =
      std::make_shared<const document::Origin>(document::Origin{text::printable(file), true});
  Value root = document::read_document(text, origin);
  if (!root.is(Value::Kind::map)) {
    fail(root.location, "expected a scene, which begins with 'clca: {}', found {}", kVersion,
         found(root));
  }
  for (const Override& given : overrides) {
    override_with(root, given, /*varies=*/false);
  }
  for (const Override& given : varied) {
    override_with(root, given, /*varies=*/true);
  }
  std::vector<std::string_view> keys = names_of(*scene_type().keys);
  std::ranges::copy(names_of(*boltzmann_type().keys), std::back_inserter(keys));
  document::evaluate_expressions(root, keys, /*text=*/"title", /*open=*/"measure");
  const bool gas = is_boltzmann(root);
  remove_none_entries(root, gas ? *boltzmann_type().keys : *scene_type().keys);
  if (gas) {
    return read_boltzmann_scene(root, file);
  }
  return read_scene(std::move(root), file);
}

std::string read_scene_text(const std::filesystem::path& file) {
  try {
    const auto bytes = text::read_file(file, document::kMaxBytes);
    return {bytes.begin(), bytes.end()};
  } catch (const text::ReadError& error) {
    const auto origin = std::make_shared<const document::Origin>(
        document::Origin{text::printable(file.string()), true});
    fail({origin, 1, 1}, "cannot read the file: {}", error.what());
  }
}

AnyScene parse_any_file(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_any(read_scene_text(file), file.string(), overrides);
}

Scene parse(std::string_view text, const std::string& file,
            const std::vector<Override>& overrides) {
  return scene_of_grains(parse_any(text, file, overrides));
}

Scene parse_file(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return scene_of_grains(parse_any_file(file, overrides));
}

std::string to_yaml(const Scene& scene) {
  return block_text(scene_type().text(scene, scene));
}

std::string to_yaml(const BoltzmannScene& scene) {
  return block_text(boltzmann_type().text(scene, Scene()));
}

void check_resolved_size(std::string_view yaml, std::string_view file) {
  const document::Origin origin = {text::printable(file) + ", with all defaults", true};
  document::check_text(yaml, std::make_shared<const document::Origin>(origin));
}

}  // namespace clca::scene
