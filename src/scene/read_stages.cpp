// Stages: what happens one after the other.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/fields.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"
#include "scene/text.hpp"

namespace clca::scene {

namespace {

Fill read_fill(const Value& value, const std::string& path, const Scene& scene) {
  const Fields fields(value, path, kFillKeys);
  Fill fill{.region = read_region(fields.at("region"), fields.path("region"), scene.box),
            .counts = std::vector<std::size_t>(scene.species.size(), 0),
            .place = to_string(value.place)};
  const std::string counts = fields.path("counts");
  for (const Entry& entry : read_map(fields.at("counts"), counts)) {
    const std::size_t species =
        read_reference(entry.key, entry.place, counts, "species", names_of(scene.species));
    fill.counts[species] = read_count(entry.value, join_path(counts, entry.key), 0, kMostParticles);
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
  for (const Value& item : read_list(*value, path, 0, kMostThings)) {
    places.push_back(read_reference(read_text(item, path), item.place, path, kind, names));
    if (std::find(places.begin(), places.end() - 1, places.back()) != places.end() - 1) {
      fail(item.place, fmt::format("{}: {} is named twice", path, found(item)));
    }
  }
  return places;
}

Until read_until(const Value& value, const std::string& path, const Scene& scene) {
  if (!value.is(Value::Kind::map)) {
    constexpr std::array<std::string_view, 1> kSettled = {"settled"};
    if (!value.is(Value::Kind::scalar) || value.text != kSettled.front()) {
      fail(value.place, fmt::format("{}: expected settled, {{steps: N}} or {{discharged: SHARE}}, "
                                    "found {}{}",
                                    path, found(value), suggestion(value.text, kSettled)));
    }
    return UntilSettled{};
  }
  const Fields fields(value, path, kUntilKeys);
  if (fields.only({"steps", "discharged"}) == "steps") {
    return UntilSteps{fields.count("steps", 1, kMostSteps)};
  }
  const double share = fields.number("discharged", 0, 1);
  if (share == 0) {
    fail(fields.at("discharged").place,
         fmt::format("{}: expected a number above 0 and up to 1, found 0",
                     fields.path("discharged")));
  }
  if (scene.outlets.empty()) {
    fail(value.place, fmt::format("{}: nothing can be discharged, the scene has no outlets", path));
  }
  return UntilDischarged{share};
}

/// Why a stage until settled would go on for ever; empty when it would not.
std::string endless(const Stage& stage, const Scene& scene) {
  if (scene.rules.candidates == automaton::Candidates::all) {
    return "with rules.candidates: all";
  }
  const lattice::Direction gravity = scene.rules.gravity;
  if (scene.box.periodic && gravity != lattice::Direction::down &&
      gravity != lattice::Direction::up) {
    return "with a sideways rules.gravity in a periodic box";
  }
  for (const std::size_t source : stage.sources) {
    if (!scene.sources[source].count) {
      return fmt::format("while source '{}' is open, which has no count",
                         scene.sources[source].name);
    }
  }
  return {};
}

/// The bound on the steps, and whether the end that the stage waits for can come at all.
std::uint64_t read_max_steps(const Fields& fields, const Stage& stage, const Scene& scene) {
  const Value* until = fields.find("until");
  const Place& place = until == nullptr ? fields.place() : until->place;
  const auto* steps = std::get_if<UntilSteps>(&stage.until);
  if (const Value* value = fields.find("max_steps")) {
    const std::uint64_t most = fields.count("max_steps", 1, kMostSteps);
    if (steps != nullptr && most < steps->steps) {
      fail(value->place, fmt::format("{}: {} is less than the {} steps of until",
                                     fields.path("max_steps"), most, steps->steps));
    }
    return most;
  }
  if (std::holds_alternative<UntilSettled>(stage.until)) {
    if (const std::string reason = endless(stage, scene); !reason.empty()) {
      fail(place,
           fmt::format("{}: never comes to rest {}; give max_steps", fields.path("until"), reason));
    }
  }
  return steps == nullptr ? stage.max_steps : std::max(stage.max_steps, steps->steps);
}

/// `stages.flow`, or the number where there is no name to go by.
std::string stage_path(const Value& value, std::size_t number) {
  const Value* name = value.find("name");
  return name != nullptr && name->is(Value::Kind::scalar)
             ? join_path("stages", name->text.substr(0, kLongestName))
             : fmt::format("stages.{}", number);
}

Stage read_stage(const Value& value, std::size_t number, const Scene& scene) {
  const Fields fields(value, stage_path(value, number), kStageKeys);
  Stage stage;
  const Value& name = fields.at("name");
  stage.name = read_text(name, fields.path("name"));
  check_name(stage.name, name.place, "stages");
  if (const Value* fill = fields.find("fill")) {
    stage.fill = read_fill(*fill, fields.path("fill"), scene);
  }
  stage.remove =
      read_references(fields.find("remove"), fields.path("remove"), "wall", names_of(scene.walls));
  stage.sources = read_references(fields.find("sources"), fields.path("sources"), "source",
                                  names_of(scene.sources));
  if (const Value* until = fields.find("until")) {
    stage.until = read_until(*until, fields.path("until"), scene);
  }
  stage.max_steps = read_max_steps(fields, stage, scene);
  return stage;
}

/// Across stages: names are unique, and a wall goes only once.
void check_history(const std::vector<Stage>& stages, const Scene& scene, const Value& value) {
  const Stage& last = stages.back();
  const Value& item = value.items[stages.size() - 1];
  for (std::size_t i = 0; i + 1 < stages.size(); ++i) {
    if (stages[i].name == last.name) {
      fail(item.find("name")->place, fmt::format("stages: the name '{}' is taken", last.name));
    }
    for (std::size_t j = 0; j < last.remove.size(); ++j) {
      const auto& gone = stages[i].remove;
      if (std::find(gone.begin(), gone.end(), last.remove[j]) != gone.end()) {
        fail(item.find("remove")->items[j].place,
             fmt::format("stages.{}.remove: wall '{}' is gone since stage '{}'", last.name,
                         scene.walls[last.remove[j]].name, stages[i].name));
      }
    }
  }
}

template <class Use>
void require_use(const Scene& scene, const Value& entries, std::string_view path,
                 std::string_view advice, Use used) {
  for (std::size_t i = 0; i < entries.entries.size(); ++i) {
    const Entry& entry = entries.entries[i];
    if (!used(scene, i)) {
      fail(entry.place, fmt::format("{}.{} is not used; {}", path, entry.key, advice));
    }
  }
}

bool opens(const Scene& scene, std::size_t source) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [source](const Stage& stage) {
    return std::find(stage.sources.begin(), stage.sources.end(), source) != stage.sources.end();
  });
}

bool fills(const Scene& scene, std::size_t species) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [species](const Stage& stage) {
    return stage.fill && stage.fill->counts[species] > 0;
  });
}

bool appears(const Scene& scene, std::size_t species) {
  return fills(scene, species) ||
         std::any_of(scene.sources.begin(), scene.sources.end(),
                     [species](const Source& source) { return source.weights[species] > 0; });
}

}  // namespace

std::vector<Stage> read_stages(const Value& value, const Scene& scene) {
  std::vector<Stage> stages;
  for (const Value& item : read_list(value, "stages", 1, kMostThings)) {
    stages.push_back(read_stage(item, stages.size(), scene));
    check_history(stages, scene, value);
  }
  return stages;
}

void check_use(const Scene& scene, const Value& root) {
  if (const Value* sources = root.find("sources")) {
    require_use(scene, *sources, "sources", "name it under sources in a stage", opens);
  }
  bool any = !scene.sources.empty();
  for (std::size_t species = 0; species < scene.species.size(); ++species) {
    any = any || fills(scene, species);
  }
  if (!any) {
    fail(root.find("stages")->place, "stages: no particles; give a stage a fill or a source");
  }
  require_use(scene, *root.find("species"), "species", "give it a count in a fill, or a source",
              appears);
}

}  // namespace clca::scene
