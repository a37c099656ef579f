// Stages: what happens one after the other.

#include <fmt/format.h>

#include <algorithm>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

Fill read_fill(const Value& value, const std::string& path, const Scene& scene) {
  const KeyedMap fields(value, path, kFillKeys);
  Fill fill{.method = fields.choice("method", kFillMethodNames, FillMethod::random),
            .region = read_region(fields.at("region"), fields.path("region"), scene.box),
            .counts = std::vector<std::size_t>(scene.species.size(), 0),
            .location = to_string(value.location)};
  if (fill.method == FillMethod::deposition && scene.rules.gravity != lattice::Direction::down) {
    fail(fields.at("method").location,
         fmt::format("{}: deposition needs rules.gravity: down", fields.path("method")));
  }
  const std::string counts = fields.path("counts");
  for (const Entry& entry : read_map(fields.at("counts"), counts)) {
    const std::size_t species =
        read_reference(entry.key, entry.location, counts, "species", names_of(scene.species));
    fill.counts[species] = read_count(entry.value, join_path(counts, entry.key), 0, kMaxParticles);
  }
  return fill;
}

/// Places in `names` of the names in a list, each at most once.
std::vector<std::size_t> read_references(const Value* value, const std::string& path,
                                         std::string_view kind,
                                         const std::vector<std::string_view>& names) {
  std::vector<std::size_t> places;
  if (value == nullptr) {
    return places;
  }
  for (const Value& item : read_list(*value, path, 0, kMaxItems)) {
    places.push_back(read_reference(read_text(item, path), item.location, path, kind, names));
    if (std::find(places.begin(), places.end() - 1, places.back()) != places.end() - 1) {
      fail(item.location, fmt::format("{}: {} is named twice", path, found(item)));
    }
  }
  return places;
}

/// `stages.flow`, or the number where there is no name to go by.
std::string stage_path(const Value& value, std::size_t number) {
  const Value* name = value.find("name");
  return name != nullptr && name->is(Value::Kind::scalar)
             ? join_path("stages", name->text.substr(0, kMaxNameLength))
             : fmt::format("stages.{}", number);
}

Stage read_stage(const Value& value, std::size_t number, const Scene& scene) {
  const KeyedMap fields(value, stage_path(value, number), kStageKeys);
  Stage stage;
  const Value& name = fields.at("name");
  stage.name = read_text(name, fields.path("name"));
  check_name(stage.name, name.location, "stages");
  if (const Value* fill = fields.find("fill")) {
    stage.fill = read_fill(*fill, fields.path("fill"), scene);
  }
  const auto walls = [&](std::string_view key) {
    return read_references(fields.find(key), fields.path(key), "wall", names_of(scene.walls));
  };
  stage.remove = walls("remove");
  stage.insert = walls("insert");
  stage.move = walls("move");
  if (const Value* insert = fields.find("insert")) {
    stage.insert_location = to_string(insert->location);
  }
  stage.sources = read_references(fields.find("sources"), fields.path("sources"), "source",
                                  names_of(scene.sources));
  if (const Value* vessel = fields.find("vessel")) {
    stage.vessel = read_vessel(*vessel, fields.path("vessel"), scene.box);
  }
  if (const Value* until = fields.find("until")) {
    stage.until = read_until(*until, fields.path("until"), stage, scene);
  }
  stage.max_steps = read_max_steps(fields, stage, scene);
  return stage;
}

}  // namespace

std::vector<Stage> read_stages(const Value& value, const Scene& scene) {
  std::vector<Stage> stages;
  for (const Value& item : read_list(value, "stages", 1, kMaxItems)) {
    stages.push_back(read_stage(item, stages.size(), scene));
  }
  return stages;
}

}  // namespace clca::scene
