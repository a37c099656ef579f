// How a wall moves.

#include <fmt/format.h>

#include <algorithm>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

using grains::WallMotion;
using Program = decltype(WallMotion::program);

void check_wave(const KeyedMap& fields, grains::Wave& wave) {
  const std::uint64_t least = grains::least_period(wave);
  if (wave.period < least) {
    fail(fields.at("period"),
         "expected at least {} steps for a {} of amplitude {}, which moves one site a step at "
         "most, found '{}'",
         least, name_of(kWaveformNames, wave.form), wave.amplitude, wave.period);
  }
}

Type<grains::Wave> wave() {
  using grains::Wave;
  return type_of<Wave>(
      {.keys = {key("form", &Wave::form, choice(kWaveformNames), "offset over time"),
                required("amplitude", &Wave::amplitude, integer(1, kMaxWaveAmplitude),
                         "sites to either side"),
                required(
                    "period", &Wave::period, count(1, kMaxWavePeriod),
                    fmt::format("steps of a cycle: at least {} for each site of amplitude of a "
                                "sine, {} of a triangle",
                                grains::kSineSteps, grains::kTriangleSteps))},
       .check = check_wave});
}

Type<int> shake_amplitude() {
  Type<int> type = integer(1, kMaxOffset);
  type.read_into = [read = type.read_into](const Place& place, void* amplitude) {
    if (place.value.is(Value::Kind::scalar) && place.value.text == "0") {
      fail(place, "expected a whole number from 1 to {}, found '0'; a shake of 0 does nothing",
           kMaxOffset);
    }
    read(place, amplitude);
  };
  return type;
}

Type<grains::Shake> shake() {
  using grains::Shake;
  const auto wait = word_or_value("settled", count(1, kMaxSteps),
                                  fmt::format("a whole number from 1 to {}", kMaxSteps));
  auto period = key("period", &Shake::period, count(1, 1'000'000), "steps for each site")
                    .of(Model::contact)
                    .defaults_to("10");
  return type_of<Shake>(
      {.keys = {required("amplitude", &Shake::amplitude, shake_amplitude(), "sites"),
                key("wait", &Shake::wait, wait, "until no particle moves, or so many steps"),
                period}});
}

using Point = grains::Path::Point;

grains::Path read_points(const Place& place) {
  grains::Path way;
  Point before;
  for (const Place& item : read_list(place, 1, kMaxPoints)) {
    const std::vector<Place> pair = read_list(item, 2, 2);
    const Point point = {.step = read_count(pair[0], 1, kMaxSteps),
                         .offset = read_int(pair[1], -kMaxOffset, kMaxOffset)};
    if (point.step <= before.step) {
      fail(pair[0], "expected a step after {}, found '{}'", before.step, point.step);
    }
    if (grains::is_steep(before, point)) {
      fail(item, "from [{}, {}] to [{}, {}] is steeper than one site a step", before.step,
           before.offset, point.step, point.offset);
    }
    way.points.push_back(point);
    before = point;
  }
  return way;
}

Type<grains::Path> path_type() {
  const Schema point =
      tuple_schema({count_schema(1, kMaxSteps), integer_schema(-kMaxOffset, kMaxOffset)});
  return own_type<grains::Path>(
      fmt::format("list of 1 to {} `[step, offset]`", kMaxPoints),
      array_schema(point, 1, kMaxPoints), read_points, [](const grains::Path& path) {
        Value list = Value::list();
        for (const Point& entry : path.points) {
          list.items.push_back(Value::scalar(fmt::format("[{}, {}]", entry.step, entry.offset)));
        }
        return list;
      });
}

/// The key of the program; empty for a drive.
std::string_view program_key(const KeyedMap& fields) {
  constexpr std::array<std::string_view, 5> kKeys = {"period", "distance", "wave", "shake", "path"};
  std::vector<std::string_view> given;
  std::ranges::copy_if(kKeys, std::back_inserter(given),
                       [&](std::string_view key) { return fields.find(key) != nullptr; });
  const bool drive = std::ranges::all_of(
      given, [](std::string_view key) { return key == "period" || key == "distance"; });
  if (!drive && given.size() > 1) {
    fail(fields, "expected either distance and period, or one of wave, shake, path, found {}",
         fmt::join(given, " and "));
  }
  return drive ? "" : given.front();
}

/// A member of grains::Drive, the program unless another is given.
template <class T>
Key<WallMotion> drive_key(std::string_view name, T grains::Drive::*member, const Type<T>& type,
                          std::string_view about) {
  return inlined_alternative(&WallMotion::program, key(name, member, type, about)).defaults_to("");
}

void check_program(const KeyedMap& fields, WallMotion& /*motion*/) {
  if (!program_key(fields).empty()) {
    return;
  }
  if (fields.find("distance") == nullptr) {
    fail(fields, "motion without bound; give distance, or one of wave, shake, path");
  }
  fields.at("direction");
}

template <class T>
Key<WallMotion> program(std::string_view name, const Type<T>& type, std::string_view about) {
  return inlined(&WallMotion::program, alternative<Program>(name, type, about));
}

}  // namespace

Type<WallMotion> motion_type() {
  return type_of<WallMotion>(
      {.keys = {key("direction", &WallMotion::direction, choice(kDirectionNames),
                    "where to; required with `distance`"),
                drive_key("period", &grains::Drive::period, count(1, kMaxSteps),
                          "steps for each site of the distance")
                    .defaults_to("1"),
                drive_key("distance", &grains::Drive::distance, integer(1, kMaxOffset),
                          "sites in all, then it stands"),
                program("wave", wave(), "to and fro about home"),
                program("shake", shake(),
                        "lifted, dropped back home, then a wait; again and again"),
                program(
                    "path", path_type(),
                    "from point to point, straight between them: steps increase, and nowhere is "
                    "it steeper than one site a step, counted from `[0, 0]`")},
       .check = check_program,
       .conditions = R"({
         "oneOf": [{"required": ["distance"]}, {"required": ["wave"]}, {"required": ["shake"]},
                   {"required": ["path"]}],
         "dependencies": {"distance": ["direction"], "period": ["distance"]}})"});
}

}  // namespace clca::scene
