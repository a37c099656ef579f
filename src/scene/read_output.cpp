// What is measured and what is written.

#include <fmt/format.h>

#include <algorithm>

#include "scene/fields.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

bool is_none(const Value* value) {
  return value == nullptr || (value->is(Value::Kind::scalar) && value->text == "none");
}

void check_map_or_none(const Value& value, const std::string& path) {
  if (!value.is(Value::Kind::map)) {
    fail(value.place, fmt::format("{}: expected a map or none, found {}", path, found(value)));
  }
}

Frames read_frames(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const Fields fields(value, path, kFramesKeys);
  Frames frames;
  frames.place = to_string(value.place);
  frames.every = fields.count("every", 1, kMostSteps, frames.every);
  frames.width = fields.integer("width", kLeastPixels, kMostPixels, frames.width);
  frames.height = fields.integer("height", kLeastPixels, kMostPixels, frames.height);
  frames.color_by = fields.choice("color_by", kColorByNames, frames.color_by);
  frames.layers = fields.integer("layers", 1, kMostLayers, frames.layers);
  if (const Value* view = fields.find("view")) {
    frames.view = read_rectangle(*view, fields.path("view"));
  }
  frames.drawing = fields.choice("drawing", kDrawingNames, frames.drawing);
  frames.supersampling =
      fields.integer("supersampling", 1, kMostSupersampling, frames.supersampling);
  frames.caption = fields.boolean("caption", frames.caption);
  return frames;
}

Series read_series(const Value& value, const std::string& path) {
  check_map_or_none(value, path);
  const Fields fields(value, path, kSeriesKeys);
  Series series;
  series.every = fields.count("every", 1, kMostSteps, series.every);
  return series;
}

}  // namespace

std::vector<Measure> read_measures(const Value& value) {
  std::vector<Measure> measures;
  for (const Value& item : read_list(value, "measure", 0, kMeasureNames.size())) {
    const Measure measure = read_choice(item, "measure", kMeasureNames);
    if (std::find(measures.begin(), measures.end(), measure) != measures.end()) {
      fail(item.place, fmt::format("measure: {} is named twice", found(item)));
    }
    measures.push_back(measure);
  }
  return measures;
}

Output read_output(const Value& value) {
  const Fields fields(value, "output", kOutputKeys);
  Output output;
  if (const Value* frames = fields.find("frames"); !is_none(frames)) {
    output.frames = read_frames(*frames, fields.path("frames"));
  }
  if (const Value* series = fields.find("series"); !is_none(series)) {
    output.series = read_series(*series, fields.path("series"));
  }
  return output;
}

}  // namespace clca::scene
