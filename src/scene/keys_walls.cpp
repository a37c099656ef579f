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
void check_part(const WallPart& part, const KeyedMap& fields, const Box& box) {
  for (const std::string_view key : kForms) {
    const Value* value = fields.find(key);
    if (value == nullptr) {
      continue;
    }
    if (const auto* rectangle = std::get_if<lattice::Rectangle>(&part)) {
      require_site(*rectangle, *value, fields.path(key), box);
    } else if (std::visit([&](const auto& form) { return covers_no_site(lattice_of(box), form); },
                          part)) {
      fail(value->location, fmt::format("{}: no site of the box, {} wide and {} high, lies on it",
                                        fields.path(key), box.width, box.height));
    }
  }
}

Type<lattice::Segment> line() {
  using lattice::Segment;
  return type_of<Segment>(
      {.keys = {required("from", &Segment::from, point(), "one end"),
                required("to", &Segment::to, point(), "the other end"),
                key("thickness", &Segment::thickness, number(0, kMaxThickness), "thickness")},
       .check = [](const KeyedMap& fields, Segment& segment, const Scene& /*scene*/) {
         if (segment.from == segment.to) {
           fail(fields.at("to").location,
                fmt::format("{}: from and to are the same point", fields.path()));
         }
       }});
}

Type<lattice::Disc> disc() {
  using lattice::Disc;
  return type_of<Disc>({.keys = {required("centre", &Disc::centre, point(), "centre"),
                                 required("radius", &Disc::radius, above_zero(kMaxCoordinate),
                                          "all sites at most this far from the centre")}});
}

Keys<lattice::Ring> ring_keys() {
  using lattice::Ring;
  return {required("centre", &Ring::centre, point(), "centre"),
          required("radius", &Ring::radius, above_zero(kMaxCoordinate), "inner radius"),
          key("thickness", &Ring::thickness, number(kMinRingThickness, kMaxThickness),
              "outer radius less the inner one")};
}

Type<lattice::Arc> arc() {
  using lattice::Arc;
  Map<Arc> map;
  for (const auto& part : ring_keys()) {
    map.keys.push_back(inlined(&Arc::ring, part));
  }
  const Type<double> angle = number(-kMaxAngle, kMaxAngle);
  map.keys.push_back(
      required("from", &Arc::from, angle, "one end, in degrees anticlockwise from the x axis"));
  map.keys.push_back(required("to", &Arc::to, angle,
                              "the other end, anticlockwise of `from` by less than 360 degrees"));
  map.check = [](const KeyedMap& fields, Arc& arc, const Scene& /*scene*/) {
    if (arc.from >= arc.to || arc.to - arc.from >= 360) {
      fail(fields.location(),
           fmt::format("{}: expected from < to, less than 360 degrees apart, found {} to {}; a "
                       "whole circle is a ring",
                       fields.path(), arc.from, arc.to));
    }
  };
  return type_of(std::move(map));
}

Keys<WallPart> forms() {
  return {alternative<WallPart>("box", rectangle(), "all sites in this rectangle"),
          alternative<WallPart>("line", line(),
                                "all sites along a straight line; nothing leaks through"),
          alternative<WallPart>("disc", disc(), "all sites in a circle"),
          alternative<WallPart>("ring", type_of<lattice::Ring>({.keys = ring_keys()}),
                                "a drum: all sites between two circles"),
          alternative<WallPart>("arc", arc(), "a part of a ring"),
          alternative<WallPart>("picture", picture_type(), "all sites on dark pixels")};
}

Type<std::vector<WallPart>> parts() {
  const Type<WallPart> part = one_of(forms());
  return {.allowed = fmt::format("list of 1 to {} of these forms", kMaxItems),
          .schema =
              [=] {
                return Json{{"type", "array"},
                            {"items", part.schema()},
                            {"minItems", 1},
                            {"maxItems", kMaxItems}};
              },
          .read =
              [=](const Value& value, const std::string& path, const Scene& scene) {
                std::vector<WallPart> result;
                for (const Value& item : read_list(value, path, 1, kMaxItems)) {
                  result.push_back(
                      part.read(item, join_path(path, std::to_string(result.size())), scene));
                }
                return result;
              },
          .text =
              [=](const std::vector<WallPart>& parts, const Scene& scene) {
                Yaml list = Yaml::list({});
                for (const WallPart& one : parts) {
                  list.items.push_back(part.text(one, scene));
                }
                return list;
              },
          .keys = part.keys,
          .is_collection = true};
}

/// A wall of a single part, which is not in a list.
Key<Wall> single(const Key<WallPart>& form) {
  Key<Wall> key;
  key.describe_as(form);
  key.read = [=](const KeyedMap& fields, Wall& wall, const Scene& scene) {
    if (fields.find(form.name) != nullptr) {
      form.read(fields, wall.parts.emplace_back(), scene);
    }
  };
  key.text = [=](const Wall& wall, const Scene& scene) {
    return wall.parts.size() == 1 ? form.text(wall.parts.front(), scene) : std::nullopt;
  };
  return key;
}

void check_wall(const KeyedMap& fields, Wall& wall, const Scene& scene) {
  wall.location = FileReference(to_string(fields.location()));
  std::vector<std::string_view> keys(kForms.begin(), kForms.end());
  keys.emplace_back("parts");
  const std::string_view given = fields.only(keys);
  if (wall.motion) {
    return;
  }
  if (const Value* passive = fields.find("passive")) {
    fail(passive->location,
         fmt::format("{}: only a wall that moves has it; give the wall a motion, or leave it out",
                     fields.path("passive")));
  }
  if (given != "parts") {
    check_part(wall.parts.front(), fields, scene.box);
    return;
  }
  const Value& list = fields.at("parts");
  for (std::size_t i = 0; i < wall.parts.size(); ++i) {
    check_part(wall.parts[i],
               KeyedMap(list.items[i], join_path(fields.path("parts"), std::to_string(i)), kForms),
               scene.box);
  }
}

}  // namespace

Type<std::vector<Wall>> walls_type() {
  Map<Wall> map = {.check = check_wall};
  for (const auto& form : forms()) {
    map.keys.push_back(single(form));
  }
  auto several = key("parts", &Wall::parts, parts(), "one body of several pieces").defaults_to("");
  several.text = [](const Wall& wall, const Scene& scene) {
    return wall.parts.size() > 1 ? std::optional(parts().text(wall.parts, scene)) : std::nullopt;
  };
  map.keys.push_back(several);
  map.keys.push_back(key("motion", &Wall::motion, motion_type(), "how it moves: [motion](#motion)")
                         .defaults_to("none: it stands"));
  auto passive = key("passive", &Wall::passive, choice(kPassiveNames),
                     "of one that moves: whether particles in its way are pushed, or entered and "
                     "left to the passive rule");
  passive.text = [text = passive.text](const Wall& wall, const Scene& scene) {
    return wall.motion ? text(wall, scene) : std::nullopt;
  };
  map.keys.push_back(passive);
  map.keys.push_back(key("friction", &Wall::friction, number(0, kMaxContactFriction),
                         "between particles and this wall")
                         .of(Model::contact)
                         .defaults_to("`contact.wall_friction`"));
  map.conditions = [] {
    Json one_form = {{{"required", {"parts"}}}};
    for (const std::string_view form : kForms) {
      one_form.push_back({{"required", {form}}});
    }
    return Json{{"oneOf", one_form}, {"dependencies", {{"passive", {"motion"}}}}};
  };
  return by_name("walls", std::move(map));
}

}  // namespace clca::scene
