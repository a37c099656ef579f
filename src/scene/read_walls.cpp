// Walls: their parts, and how they move.

#include <fmt/format.h>

#include <algorithm>

#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

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

lattice::Segment read_line(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kLineKeys);
  lattice::Segment segment = {.from = read_point(fields.at("from"), fields.path("from")),
                              .to = read_point(fields.at("to"), fields.path("to")),
                              .thickness = fields.number("thickness", 0, kMaxThickness, 1)};
  if (segment.from == segment.to) {
    fail(fields.at("to").location, fmt::format("{}: from and to are the same point", path));
  }
  return segment;
}

lattice::Disc read_disc(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kDiscKeys);
  return {.centre = read_point(fields.at("centre"), fields.path("centre")),
          .radius = fields.positive("radius", kMaxCoordinate)};
}

lattice::Ring read_ring(const KeyedMap& fields) {
  return {.centre = read_point(fields.at("centre"), fields.path("centre")),
          .radius = fields.positive("radius", kMaxCoordinate),
          .thickness = fields.number("thickness", kMinRingThickness, kMaxThickness, 1)};
}

lattice::Arc read_arc(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kArcKeys);
  lattice::Arc arc = {.ring = read_ring(fields),
                      .from = fields.number("from", -kMaxAngle, kMaxAngle),
                      .to = fields.number("to", -kMaxAngle, kMaxAngle)};
  if (arc.from >= arc.to || arc.to - arc.from >= 360) {
    fail(value.location,
         fmt::format("{}: expected from < to, less than 360 degrees apart, found {} "
                     "to {}; a whole circle is a ring",
                     path, arc.from, arc.to));
  }
  return arc;
}

WallPart read_form(const Value& value, std::string_view key, const std::string& path) {
  if (key == "box") {
    return read_rectangle(value, path);
  }
  if (key == "line") {
    return read_line(value, path);
  }
  if (key == "disc") {
    return read_disc(value, path);
  }
  if (key == "ring") {
    return read_ring(KeyedMap(value, path, kRingKeys));
  }
  return read_arc(value, path);
}

/// What is under one of kPartKeys. Only a wall that moves may be outside the box at home.
WallPart read_part(const KeyedMap& fields, std::string_view key, const Box& box, bool moves) {
  const Value& value = fields.at(key);
  const std::string path = fields.path(key);
  if (key == "box" && !moves) {
    return read_region(value, path, box);
  }
  WallPart part = read_form(value, key, path);
  const lattice::Lattice lattice = lattice_of(box);
  const auto empty = [&](const auto& form) { return covers_no_site(lattice, form); };
  if (!moves && std::visit(empty, part)) {
    fail(value.location, fmt::format("{}: no site of the box, {} wide and {} high, lies on it",
                                     path, box.width, box.height));
  }
  return part;
}

std::vector<WallPart> read_parts(const KeyedMap& fields, const Box& box, bool moves) {
  const std::string_view key = fields.only({"box", "line", "disc", "ring", "arc", "parts"});
  if (key != "parts") {
    return {read_part(fields, key, box, moves)};
  }
  std::vector<WallPart> parts;
  const std::string path = fields.path(key);
  for (const Value& item : read_list(fields.at(key), path, 1, kMaxItems)) {
    const KeyedMap part(item, join_path(path, std::to_string(parts.size())), kPartKeys);
    parts.push_back(read_part(part, part.only({"box", "line", "disc", "ring", "arc"}), box, moves));
  }
  return parts;
}

Wall read_wall(const Entry& entry, const Box& box) {
  const KeyedMap fields(entry.value, join_path("walls", entry.key), kWallKeys);
  const Value* motion = fields.find("motion");
  const Value* passive = fields.find("passive");
  Wall wall{.name = entry.key, .parts = read_parts(fields, box, motion != nullptr)};
  wall.location = to_string(entry.value.location);
  if (motion != nullptr) {
    wall.motion = read_motion(*motion, fields.path("motion"));
  } else if (passive != nullptr) {
    fail(passive->location,
         fmt::format("{}: only a wall that moves has it; give the wall a motion, or leave it out",
                     fields.path("passive")));
  }
  wall.passive = fields.choice("passive", kPassiveNames, wall.passive);
  if (fields.find("friction") != nullptr) {
    wall.friction = fields.number("friction", 0, kMaxContactFriction);
  }
  return wall;
}

}  // namespace

std::vector<Wall> read_walls(const Value& value, const Scene& scene) {
  std::vector<Wall> walls;
  for (const Entry& entry : read_named(value, "walls")) {
    walls.push_back(read_wall(entry, scene.box));
  }
  return walls;
}

}  // namespace clca::scene
