// How a wall moves.

#include <fmt/format.h>

#include <algorithm>

#include "clca/text/message.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

grains::Drive read_drive(const KeyedMap& fields, const std::string& path) {
  if (fields.find("distance") == nullptr) {
    fail(fields.location(),
         fmt::format("{}: motion without bound; give distance, or one of wave, shake, path", path));
  }
  fields.at("direction");
  return {.period = fields.count("period", 1, kMaxSteps, 1),
          .distance = fields.integer("distance", 1, kMaxOffset)};
}

grains::Wave read_wave(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kWaveKeys);
  grains::Wave wave;
  wave.form = fields.choice("form", kWaveformNames, wave.form);
  wave.amplitude = fields.integer("amplitude", 1, kMaxWaveAmplitude);
  wave.period = fields.count("period", 1, kMaxWavePeriod);
  const bool sine = wave.form == grains::Waveform::sine;
  const std::uint64_t least =
      (sine ? kSineSteps : kTriangleSteps) * static_cast<std::uint64_t>(wave.amplitude);
  if (wave.period < least) {
    fail(fields.at("period").location,
         fmt::format("{}: expected at least {} steps for a {} of amplitude {}, which moves one "
                     "site a step at most, found '{}'",
                     fields.path("period"), least, name_of(kWaveformNames, wave.form),
                     wave.amplitude, wave.period));
  }
  return wave;
}

/// The steps of a wait; none until settled.
std::optional<std::uint64_t> read_wait(const Value* value, const std::string& path) {
  constexpr std::array<std::string_view, 1> kSettled = {"settled"};
  if (value == nullptr || (value->is(Value::Kind::scalar) && value->text == kSettled.front())) {
    return {};
  }
  if (value->text.empty() || value->text.front() < '0' || value->text.front() > '9') {
    fail(value->location,
         fmt::format("{}: expected settled or a whole number from 1 to {}, found {}{}", path,
                     kMaxSteps, found(*value), text::suggestion(value->text, kSettled)));
  }
  return read_count(*value, path, 1, kMaxSteps);
}

grains::Shake read_shake(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kShakeKeys);
  const Value& amplitude = fields.at("amplitude");
  if (amplitude.is(Value::Kind::scalar) && amplitude.text == "0") {
    fail(amplitude.location,
         fmt::format("{}: expected a whole number from 1 to {}, found '0'; a shake of 0 does "
                     "nothing",
                     fields.path("amplitude"), kMaxOffset));
  }
  grains::Shake shake = {.amplitude = fields.integer("amplitude", 1, kMaxOffset),
                         .wait = read_wait(fields.find("wait"), fields.path("wait"))};
  if (fields.find("period") != nullptr) {
    shake.period = fields.count("period", 1, kMaxShakePeriod);
  }
  return shake;
}

using Point = grains::Path::Point;

/// Whether the way between the points is longer in sites than in steps.
bool too_steep(const Point& from, const Point& to) {
  const auto rise = static_cast<std::int64_t>(to.offset) - from.offset;
  return static_cast<std::uint64_t>(rise < 0 ? -rise : rise) > to.step - from.step;
}

grains::Path read_path(const Value& value, const std::string& path) {
  grains::Path way;
  Point before;
  for (const Value& item : read_list(value, path, 1, kMaxPoints)) {
    const std::vector<Value>& pair = read_list(item, path, 2, 2);
    const Point point = {.step = read_count(pair[0], path, 1, kMaxSteps),
                         .offset = read_int(pair[1], path, -kMaxOffset, kMaxOffset)};
    if (point.step <= before.step) {
      fail(pair[0].location,
           fmt::format("{}: expected a step after {}, found '{}'", path, before.step, point.step));
    }
    if (too_steep(before, point)) {
      fail(item.location,
           fmt::format("{}: from [{}, {}] to [{}, {}] is steeper than one site a step", path,
                       before.step, before.offset, point.step, point.offset));
    }
    way.points.push_back(point);
    before = point;
  }
  return way;
}

/// The key of the program; empty for a drive.
std::string_view program_key(const KeyedMap& fields, const std::string& path) {
  constexpr std::array<std::string_view, 5> kKeys = {"period", "distance", "wave", "shake", "path"};
  std::vector<std::string_view> given;
  std::copy_if(kKeys.begin(), kKeys.end(), std::back_inserter(given),
               [&](std::string_view key) { return fields.find(key) != nullptr; });
  const bool drive = std::all_of(given.begin(), given.end(), [](std::string_view key) {
    return key == "period" || key == "distance";
  });
  if (!drive && given.size() > 1) {
    fail(fields.location(),
         fmt::format("{}: expected either distance and period, or one of wave, shake, path, found "
                     "{}",
                     path, fmt::join(given, " and ")));
  }
  return drive ? "" : given.front();
}

}  // namespace

grains::WallMotion read_motion(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kMotionKeys);
  const std::string_view key = program_key(fields, path);
  grains::WallMotion motion;
  motion.direction = fields.choice("direction", kDirectionNames, lattice::Direction::up);
  if (key == "wave") {
    motion.program = read_wave(fields.at(key), fields.path(key));
  } else if (key == "shake") {
    motion.program = read_shake(fields.at(key), fields.path(key));
  } else if (key == "path") {
    motion.program = read_path(fields.at(key), fields.path(key));
  } else {
    motion.program = read_drive(fields, path);
  }
  return motion;
}

}  // namespace clca::scene
