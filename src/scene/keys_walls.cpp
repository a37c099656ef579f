// Walls: their parts, and how they move.

#include <fmt/format.h>

#include <algorithm>

#include "scene/geometry.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::array<std::string_view, 6> kForms = {"box",  "line", "disc",
                                                    "ring", "arc",  "picture"};

/// Parameter range (0 to 1) of the segment inside the rectangle; low > high if none.
std::pair<double, double> clipped(const lattice::Segment& segment,
                                  const lattice::Rectangle& rectangle) {
  double low = 0;
  double high = 1;
  const auto clip = [&](double from, double along, double least, double most) {
    if (along == 0) {
      high = from >= least && from <= most ? high : -1;
      return;
    }
    const auto [enter, leave] = std::minmax({(least - from) / along, (most - from) / along});
    low = std::max(low, enter);
    high = std::min(high, leave);
  };
  const Eigen::Vector2d along = segment.to - segment.from;
  clip(segment.from.x(), along.x(), rectangle.left, rectangle.right);
  clip(segment.from.y(), along.y(), rectangle.bottom, rectangle.top);
  return {low, high};
}

bool covers_no_site(const lattice::Lattice& lattice, const lattice::Segment& segment) {
  // More than two spacings inside, every point has a nearby site; this avoids counting the sites of
  // long walls.
  const lattice::Rectangle inside = {2, 2, lattice::kColumnPitch * lattice.columns() - 3,
                                     lattice.rows() - 3.0};
  const auto [low, high] = clipped(segment, inside);
  const bool crosses = inside.left < inside.right && inside.bottom < inside.top && low <= high;
  return !crosses && lattice::sites_along(lattice, segment).empty();
}

template <class Form>
bool covers_no_site(const lattice::Lattice& lattice, const Form& form) {
  return holds_no_site(lattice, form);
}

/// Refuses a form without a site of the box. Only a wall that moves may be outside it at home.
void check_part(const WallPart& part, const Place& fields) {
  const Place place = fields.at(kForms[part.index()]);
  const Box& box = fields.scene.box;
  if (const auto* rectangle = std::get_if<lattice::Rectangle>(&part)) {
    require_site(*rectangle, place);
  } else if (std::visit([&](const auto& form) { return covers_no_site(lattice_of(box), form); },
                        part)) {
    fail(place, "no site of the box, {} wide and {} high, lies on it", box.width, box.height);
  }
}

Type<lattice::Segment> line() {
  using lattice::Segment;
  return type_of<Segment>({.keys = {required("from", &Segment::from, point(), "one end"),
                                    required("to", &Segment::to, point(), "the other end"),
                                    key("thickness", &Segment::thickness,
                                        length(number(0, kMaxThickness)), "thickness")},
                           .check = [](const KeyedMap& fields, Segment& segment) {
                             if (segment.from == segment.to) {
                               fail(fields.at("to").value.location,
                                    "{}: from and to are the same point", fields.path);
                             }
                           }});
}

Type<Disc> disc() {
  return type_of<Disc>(
      {.keys = {required("centre", &Disc::centre, point(), "centre"),
                required("radius", &Disc::radius, length(above_zero(kMaxCoordinate)),
                         "all sites at most this far from the centre")}});
}

Keys<Ring> ring_keys() {
  return {required("centre", &Ring::centre, point(), "centre"),
          required("radius", &Ring::radius, length(above_zero(kMaxCoordinate)), "inner radius"),
          key("thickness", &Ring::thickness, length(number(kMinRingThickness, kMaxThickness)),
              "outer radius less the inner one")};
}

void check_arc(const KeyedMap& fields, Arc& arc) {
  if (arc.from >= arc.to || arc.to - arc.from >= 360) {
    fail(
        fields,
        "expected from < to, less than 360 degrees apart, found {} to {}; a whole circle is a ring",
        arc.from, arc.to);
  }
}

Type<Arc> arc() {
  const Type<double> angle = number(-kMaxAngle, kMaxAngle);
  Keys<Arc> keys = inlined<Arc>(to_member(&Arc::ring), ring_keys());
  keys.add(
      {required("from", &Arc::from, angle, "one end, in degrees anticlockwise from the x axis"),
       required("to", &Arc::to, angle,
                "the other end, anticlockwise of `from` by less than 360 degrees")});
  return type_of<Arc>({.keys = keys, .check = check_arc});
}

Keys<WallPart> forms() {
  return {alternative<WallPart>("box", rectangle(), "all sites in this rectangle"),
          alternative<WallPart>("line", line(),
                                "all sites along a straight line; nothing leaks through"),
          alternative<WallPart>("disc", disc(), "all sites in a circle"),
          alternative<WallPart>("ring", type_of<Ring>({.keys = ring_keys()}),
                                "a drum: all sites between two circles"),
          alternative<WallPart>("arc", arc(), "a part of a ring"),
          alternative<WallPart>("picture", picture_type(), "all sites on dark pixels")};
}

Type<std::vector<WallPart>> parts() {
  auto type = list_of(one_of(forms()), 1, kMaxItems, [](const Place& item, std::size_t index) {
    return join_path(item.path, std::to_string(index));
  });
  type.allowed = fmt::format("list of 1 to {} of these forms", kMaxItems);
  return type;
}

void check_wall(const KeyedMap& fields, Wall& wall) {
  wall.location = reference(fields);
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
  const Place list = fields.at("parts");
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
  Keys<Wall> keys = inlined<Wall>(single, forms());
  keys.add({key("parts", &Wall::parts, parts(), "one body of several pieces")
                .defaults_to("")
                .written_as([](const Wall& wall, const Scene& scene) {
                  return wall.parts.size() > 1 ? std::optional(parts().text(wall.parts, scene))
                                               : std::nullopt;
                }),
            key("motion", &Wall::motion, motion_type(), "how it moves: [motion](#motion)")
                .defaults_to("none: it stands"),
            key("passive", &Wall::passive, choice(kPassiveNames),
                "of one that moves: whether particles in its way are pushed, or entered and "
                "left to the passive rule")
                .written_as([](const Wall& wall) {
                  return wall.motion ? std::optional(Value::scalar(
                                           std::string(name_of(kPassiveNames, wall.passive))))
                                     : std::nullopt;
                }),
            key("friction", &Wall::friction, number(0, contact::kMaxFriction),
                "between particles and this wall")
                .of(Model::contact)
                .defaults_to("`contact.wall_friction`")});
  std::vector<std::string> one_of(kForms.begin(), kForms.end());
  one_of.emplace_back("parts");
  return by_name<Wall>("walls", {.keys = keys,
                                 .one_of = one_of,
                                 .check = check_wall,
                                 .conditions = R"({"dependencies": {"passive": ["motion"]}})"});
}

}  // namespace clca::scene
