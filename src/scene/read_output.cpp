// What is measured and what is written.

#include <fmt/format.h>

#include <algorithm>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

void check_map_or_none(const Value& value, const std::string& path) {
  if (!value.is(Value::Kind::map)) {
    fail(value.location, fmt::format("{}: expected a map or none, found {}", path, found(value)));
  }
}

bool lets_overlap(const Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(),
                     [](const Wall& wall) { return wall.passive == grains::Passive::overlap; });
}

bool moves_in_cycles(const Scene& scene) {
  return std::any_of(
             scene.walls.begin(), scene.walls.end(),
             [](const Wall& wall) { return wall.motion && grains::is_cyclic(*wall.motion); }) ||
         std::any_of(scene.stages.begin(), scene.stages.end(), vessel_has_cycles);
}

/// In the automaton there are forces only where walls enter particles.
void require_overlap(const Value& value, const std::string& path, std::string_view what,
                     const Scene& scene) {
  if (!lets_overlap(scene)) {
    fail(value.location,
         fmt::format("{}: no {} without a wall that moves with passive: overlap", path, what));
  }
}

/// What can be drawn depends on how walls move.
void check_drawn(const KeyedMap& fields, const Frames& frames, const Scene& scene) {
  if (frames.color_by == ColorBy::force && scene.model == Model::automaton) {
    require_overlap(fields.at("color_by"), fields.path("color_by"), "force", scene);
  }
  if (frames.overlay == Overlay::forces && scene.model == Model::automaton) {
    require_overlap(fields.at("overlay"), fields.path("overlay"), "forces", scene);
  }
  if (frames.overlay == Overlay::arrows && !moves_in_cycles(scene)) {
    fail(fields.at("overlay").location,
         fmt::format("{}: no arrows without a stage that moves a wall with a wave or a shake, or "
                     "that turns or shakes the vessel",
                     fields.path("overlay")));
  }
}

Frames read_frames(const Value& value, const std::string& path, const Scene& scene) {
  check_map_or_none(value, path);
  const KeyedMap fields(value, path, kFramesKeys);
  Frames frames;
  frames.location = to_string(value.location);
  frames.every = fields.count("every", 1, kMaxSteps, frames.every);
  frames.width = fields.integer("width", kMinPixels, kMaxPixels, frames.width);
  frames.height = fields.integer("height", kMinPixels, kMaxPixels, frames.height);
  frames.color_by = fields.choice("color_by", kColorByNames, frames.color_by);
  frames.layers = fields.integer("layers", 1, kMaxLayers, frames.layers);
  if (const Value* view = fields.find("view")) {
    frames.view = read_rectangle(*view, fields.path("view"));
  }
  frames.drawing = fields.choice("drawing", kDrawingNames, frames.drawing);
  frames.supersampling =
      fields.integer("supersampling", 1, kMaxSupersampling, frames.supersampling);
  frames.caption = fields.boolean("caption", frames.caption);
  frames.upright = fields.boolean("upright", frames.upright);
  if (fields.find("force_scale") != nullptr) {
    frames.force_scale = fields.positive("force_scale", kMaxForceScale);
  }
  frames.overlay = fields.choice("overlay", kOverlayNames, frames.overlay);
  check_drawn(fields, frames, scene);
  return frames;
}

Series read_series(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const KeyedMap fields(value, path, kSeriesKeys);
  Series series;
  series.every = fields.count("every", 1, kMaxSteps, series.every);
  return series;
}

Fields read_fields(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const KeyedMap map(value, path, kFieldsKeys);
  Fields fields;
  fields.cell = map.number("cell", 1, kMaxCellSide, fields.cell);
  fields.every = map.count("every", 1, kMaxSteps, fields.every);
  return fields;
}

Contacts read_contacts(const Value& value, const std::string& path, const Scene& scene) {
  check_map_or_none(value, path);
  const KeyedMap fields(value, path, kContactsKeys);
  Contacts contacts;
  contacts.every = fields.count("every", 1, kMaxSteps, contacts.every);
  if (scene.model == Model::contact) {
    contacts.window = fields.count("window", 1, kMaxSteps, contacts.window);
    if (contacts.every > contacts.window) {
      fail(fields.at("every").location,
           fmt::format("{}: expected 1 to {}, the steps of {}, found {}", fields.path("every"),
                       contacts.window, fields.path("window"), contacts.every));
    }
  } else {
    require_overlap(value, path, "contacts", scene);
  }
  return contacts;
}

TrajectoryOutput read_trajectory(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const KeyedMap fields(value, path, kTrajectoryKeys);
  TrajectoryOutput trajectory;
  trajectory.every = fields.count("every", 1, kMaxSteps, trajectory.every);
  trajectory.contacts = fields.boolean("contacts", trajectory.contacts);
  return trajectory;
}

Checkpoints read_steps_and_seconds(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const KeyedMap fields(value, path, kCheckpointKeys);
  Checkpoints checkpoints;
  if (fields.find("every") != nullptr) {
    checkpoints.every = fields.count("every", 1, kMaxSteps);
  }
  if (fields.find("seconds") != nullptr) {
    checkpoints.seconds = fields.positive("seconds", kMaxWait);
  }
  if (!checkpoints.every && !checkpoints.seconds) {
    fail(value.location, fmt::format("{}: expected every (steps), seconds or both", path));
  }
  return checkpoints;
}

}  // namespace

bool is_none(const Value* value) {
  return value == nullptr || (value->is(Value::Kind::scalar) && value->text == "none");
}

std::vector<Measure> read_measures(const Value& value) {
  std::vector<Measure> measures;
  for (const Value& item : read_list(value, "measure", 0, kMeasureNames.size())) {
    const Measure measure = read_choice(item, "measure", kMeasureNames);
    if (std::find(measures.begin(), measures.end(), measure) != measures.end()) {
      fail(item.location, fmt::format("measure: {} is named twice", found(item)));
    }
    measures.push_back(measure);
  }
  return measures;
}

Output read_output(const Value& value, const Scene& scene) {
  const KeyedMap fields(value, "output", kOutputKeys);
  Output output;
  if (const Value* frames = fields.find("frames"); !is_none(frames)) {
    output.frames = read_frames(*frames, fields.path("frames"), scene);
  }
  if (const Value* series = fields.find("series"); !is_none(series)) {
    output.series = read_series(*series, fields.path("series"));
  }
  if (const Value* means = fields.find("fields"); !is_none(means)) {
    output.fields = read_fields(*means, fields.path("fields"));
  }
  if (const Value* contacts = fields.find("contacts"); !is_none(contacts)) {
    output.contacts = read_contacts(*contacts, fields.path("contacts"), scene);
  }
  if (const Value* trajectory = fields.find("trajectory"); !is_none(trajectory)) {
    output.trajectory = read_trajectory(*trajectory, fields.path("trajectory"));
  }
  output.checkpoint = kDefaultCheckpoints;
  if (const Value* checkpoint = fields.find("checkpoint")) {
    output.checkpoint =
        is_none(checkpoint)
            ? std::nullopt
            : std::optional(read_steps_and_seconds(*checkpoint, fields.path("checkpoint")));
  }
  return output;
}

}  // namespace clca::scene
