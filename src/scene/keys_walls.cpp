// Walls: their parts, and how they move.

#include <algorithm>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMaxThickness = 100;        // lattice spacings
constexpr int kMaxOffset = 1'000'000;        // of a moving wall from home
constexpr std::size_t kMaxPoints = 100'000;  // of a path

using grains::WallMotion;

void check_wave(const PlacedValue& fields, grains::Wave& wave) {
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
      {.keys = {key("form", &Wave::form, choice_type(kWaveformNames), "offset over time"),
                // The limits of amplitude and period: a sine takes 4 x amplitude x period squared
                // in 64 bits.
                required_key("amplitude", &Wave::amplitude, integer_type(1, 10'000),
                             "sites to either side"),
                required_key(
                    "period", &Wave::period, count_type(1, 10'000'000),
                    fmt::format("steps of a cycle: at least {} for each site of amplitude of a "
                                "sine, {} of a triangle",
                                grains::kSineStepsPerSite, grains::kTriangleStepsPerSite))},
       .check = check_wave});
}

Type<grains::Shake> shake() {
  using grains::Shake;
  const auto wait = word_or_value("settled", count_type(1, kMaxSteps),
                                  fmt::format("a whole number from 1 to {}", kMaxSteps));
  auto period = key("period", &Shake::period, count_type(1, 1'000'000), "steps for each site")
                    .of(Model::contact)
                    .defaults_to("10");
  return type_of<Shake>(
      {.keys = {required_key("amplitude", &Shake::amplitude, integer_type(1, kMaxOffset), "sites"),
                key("wait", &Shake::wait, wait, "until no particle moves, or so many steps"),
                period}});
}

using Point = grains::Path::Point;

grains::Path read_points(const PlacedValue& place) {
  grains::Path way;
  Point before;
  for (const PlacedValue& item : read_list(place, 1, kMaxPoints)) {
    const std::vector<PlacedValue> pair = read_list(item, 2, 2);
    const Point point = {.step = read_number<std::uint64_t>(pair[0], 1, kMaxSteps),
                         .offset = read_number(pair[1], -kMaxOffset, kMaxOffset)};
    if (point.step <= before.step) {
      fail(pair[0], "expected a step after {}, found '{}'", before.step, point.step);
    }
    if (grains::is_too_steep(before, point)) {
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
      fmt::format(R"({{"type": "array", "items": [{}, {}], "minItems": 2, "maxItems": 2}})",
                  count_type(1, kMaxSteps).schema, integer_type(-kMaxOffset, kMaxOffset).schema);
  return custom_type<grains::Path>(
      fmt::format("list of 1 to {} `[step, offset]`", kMaxPoints),
      array_schema(point, 1, kMaxPoints), read_points, [](const grains::Path& path) {
        Value list = Value::list();
        for (const Point& entry : path.points) {
          list.items.push_back(Value::scalar(fmt::format("[{}, {}]", entry.step, entry.offset)));
        }
        return list;
      });
}

void check_program(const PlacedValue& fields, WallMotion& motion) {
  constexpr std::array<std::string_view, 5> kKeys = {"period", "distance", "wave", "shake", "path"};
  std::vector<std::string_view> given;
  std::ranges::copy_if(kKeys, std::back_inserter(given),
                       [&](std::string_view key) { return fields.find(key) != nullptr; });
  const bool is_drive = std::holds_alternative<grains::Drive>(motion.program);
  if (!is_drive && given.size() > 1) {
    fail(fields, "expected either distance and period, or one of wave, shake, path, found {}",
         fmt::join(given, " and "));
  }
  if (is_drive && fields.find("distance") == nullptr) {
    fail(fields, "motion without bound; give distance, or one of wave, shake, path");
  }
  if (is_drive) {
    fields.at("direction");
  }
}

Type<WallMotion> motion_type() {
  return type_of<WallMotion>(
      {.keys = {key("direction", &WallMotion::direction, choice_type(kDirectionNames),
                    "where to; required with `distance`"),
                inlined_alternative(&WallMotion::program,
                                    key("period", &grains::Drive::period, count_type(1, kMaxSteps),
                                        "steps for each site of the distance"))
                    .defaults_to("1"),
                inlined_alternative(&WallMotion::program, key("distance", &grains::Drive::distance,
                                                              integer_type(1, kMaxOffset),
                                                              "sites in all, then it stands"))
                    .defaults_to(""),
                alternative_key("wave", &WallMotion::program, wave(), "to and fro about home"),
                alternative_key("shake", &WallMotion::program, shake(),
                                "lifted, dropped back home, then a wait; again and again"),
                alternative_key(
                    "path", &WallMotion::program, path_type(),
                    "from point to point, straight between them: steps increase, and nowhere is "
                    "it steeper than one site a step, counted from `[0, 0]`")},
       .check = check_program,
       .schema_members = R"(
         "oneOf": [{"required": ["distance"]}, {"required": ["wave"]}, {"required": ["shake"]},
                   {"required": ["path"]}],
         "dependencies": {"distance": ["direction"], "period": ["distance"]})"});
}

Type<lattice::Segment> line() {
  using lattice::Segment;
  return type_of<Segment>({.keys = {required_key("from", &Segment::from, point_type(), "one end"),
                                    required_key("to", &Segment::to, point_type(), "the other end"),
                                    key("thickness", &Segment::thickness,
                                        length_type(number_type(0, kMaxThickness)), "thickness")},
                           .check = [](const PlacedValue& fields, Segment& segment) {
                             if (segment.from == segment.to) {
                               fail(fields.at("to").value.location,
                                    "{}: from and to are the same point", fields.path);
                             }
                           }});
}

Type<Disc> disc() {
  return type_of<Disc>(
      {.keys = {required_key("centre", &Disc::centre, point_type(), "centre"),
                required_key("radius", &Disc::radius, length_type(positive_type(kMaxCoordinate)),
                             "all sites at most this far from the centre")}});
}

Keys<Ring> ring_keys() {
  return {required_key("centre", &Ring::centre, point_type(), "centre"),
          required_key("radius", &Ring::radius, length_type(positive_type(kMaxCoordinate)),
                       "inner radius"),
          // A thinner ring would let sites through.
          key("thickness", &Ring::thickness, length_type(number_type(1, kMaxThickness)),
              "outer radius less the inner one")};
}

void check_arc(const PlacedValue& fields, Arc& arc) {
  if (arc.from_degrees >= arc.to_degrees || arc.to_degrees - arc.from_degrees >= 360) {
    fail(
        fields,
        "expected from < to, less than 360 degrees apart, found {} to {}; a whole circle is a ring",
        arc.from_degrees, arc.to_degrees);
  }
}

Type<Arc> arc() {
  const Type<double> angle = number_type(-360, 360);
  Keys<Arc> keys = inlined_keys<Arc>(member_access(&Arc::ring), ring_keys());
  keys.add({required_key("from", &Arc::from_degrees, angle,
                         "one end, in degrees anticlockwise from the x axis"),
            required_key("to", &Arc::to_degrees, angle,
                         "the other end, anticlockwise of `from` by less than 360 degrees")});
  return type_of<Arc>({.keys = keys, .check = check_arc});
}

const Keys<WallPart>& forms() {
  static const Keys<WallPart> kForms = {
      alternative_key<WallPart>("box", rectangle_type(), "all sites in this rectangle"),
      alternative_key<WallPart>("line", line(),
                                "all sites along a straight line; nothing leaks through"),
      alternative_key<WallPart>("disc", disc(), "all sites in a circle"),
      alternative_key<WallPart>("ring", type_of<Ring>({.keys = ring_keys()}),
                                "a drum: all sites between two circles"),
      alternative_key<WallPart>("arc", arc(), "a part of a ring"),
      alternative_key<WallPart>("picture", picture_type(), "all sites on dark pixels")};
  return kForms;
}

Type<std::vector<WallPart>> parts() {
  auto type =
      list_type(one_of_type(forms()), 1, kMaxItems, [](const PlacedValue& item, std::size_t index) {
        return join_path(item.path, std::to_string(index));
      });
  type.allowed = fmt::format("list of 1 to {} of these forms", kMaxItems);
  return type;
}

/// Refuses a form without a site of the box. Only a wall that moves may be outside it at home.
void check_part(const WallPart& part, const PlacedValue& fields) {
  static const std::vector<std::string> kNames = names_of<std::string>(forms());
  const PlacedValue place = fields.at(kNames[part.index()]);
  const Box& box = fields.scene.box;
  if (const auto* rectangle = std::get_if<lattice::Rectangle>(&part)) {
    require_site(*rectangle, place);
  } else if (std::visit([&](const auto& form) { return holds_no_site(lattice_of(box), form); },
                        part)) {
    fail(place, "no site of the box, {} wide and {} high, lies on it", box.width, box.height);
  }
}

void check_wall(const PlacedValue& fields, Wall& wall) {
  wall.location = location_text(fields);
  if (wall.motion) {
    return;
  }
  if (fields.find("passive") != nullptr) {
    fail(fields.at("passive"),
         "only a wall that moves has it; give the wall a motion, or leave it out");
  }
  if (fields.find("parts") == nullptr) {
    check_part(wall.parts.front(), fields);
    return;
  }
  const PlacedValue list = fields.at("parts");
  for (std::size_t i = 0; i < wall.parts.size(); ++i) {
    check_part(wall.parts[i],
               {list.value.items[i], join_path(list.path, std::to_string(i)), list.scene});
  }
}

}  // namespace

Type<std::vector<Wall>> walls_type() {
  // A wall of a single part is not in a list.
  const auto single = [](void* wall, bool make) -> void* {
    std::vector<WallPart>& parts = static_cast<Wall*>(wall)->parts;
    return make ? &parts.emplace_back() : parts.size() == 1 ? parts.data() : nullptr;
  };
  Keys<Wall> keys = inlined_keys<Wall>(single, forms());
  keys.add({key("parts", &Wall::parts, parts(), "one body of several pieces")
                .defaults_to("")
                .written_if([](const Wall& wall) { return wall.parts.size() > 1; }),
            key("motion", &Wall::motion, motion_type(), "how it moves: [motion](#motion)")
                .defaults_to("none: it stands"),
            key("passive", &Wall::passive_rule, choice_type(kPassiveNames),
                "of one that moves: whether particles in its way are pushed, or entered and "
                "left to the passive rule")
                .written_if([](const Wall& wall) { return wall.motion.has_value(); }),
            key("friction", &Wall::friction, number_type(0, contact::kMaxFriction),
                "between particles and this wall")
                .of(Model::contact)
                .defaults_to("`contact.wall_friction`")});
  std::vector<std::string> one_of = names_of<std::string>(forms());
  one_of.emplace_back("parts");
  return by_name<Wall>("walls", {.keys = keys,
                                 .one_of = one_of,
                                 .check = check_wall,
                                 .schema_members = R"("dependencies": {"passive": ["motion"]})"});
}

}  // namespace clca::scene
