// The contact model.

#include <fmt/format.h>

#include "scene/fields.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"
#include "scene/text.hpp"

namespace clca::scene {

namespace {

int read_sweeps(const KeyedMap& fields, int otherwise) {
  const int sweeps = fields.integer("sweeps", kFewestSweeps, kMostSweeps, otherwise);
  if (sweeps % 2 != 0) {
    fail(fields.at("sweeps").place,
         fmt::format("{}: expected an even number, as every second sweep goes backwards, found "
                     "'{}'",
                     fields.path("sweeps"), sweeps));
  }
  return sweeps;
}

/// 0 for `auto`.
double read_fall_height(const Value& value, const std::string& path) {
  constexpr std::array<std::string_view, 1> kWords = {kAutoHeight};
  if (value.is(Value::Kind::scalar) && value.text == kAutoHeight) {
    return 0;
  }
  if (value.text.empty() || value.text.front() < '0' || value.text.front() > '9') {
    fail(value.place,
         fmt::format("{}: expected {} or a number above 0 and up to {}, found {}{}", path,
                     kAutoHeight, kHighestFall, found(value), suggestion(value.text, kWords)));
  }
  return read_positive(value, path, kHighestFall);
}

}  // namespace

contact::Parameters read_contact(const Value& value) {
  const KeyedMap fields(value, "contact", kContactModelKeys);
  contact::Parameters contact;
  contact.friction = fields.number("friction", 0, kGreatestContactFriction, contact.friction);
  contact.wall_friction =
      fields.number("wall_friction", 0, kGreatestContactFriction, contact.wall_friction);
  contact.rolling = fields.choice("rolling", kRollingNames, contact.rolling);
  contact.rolling_friction =
      fields.number("rolling_friction", 0, kGreatestContactFriction, contact.rolling_friction);
  contact.restitution =
      fields.number("restitution", 0, kGreatestContactRestitution, contact.restitution);
  contact.sweeps = read_sweeps(fields, contact.sweeps);
  contact.resolution =
      fields.number("resolution", kFinestResolution, kCoarsestResolution, contact.resolution);
  if (const Value* height = fields.find("fall_height")) {
    contact.fall_height = read_fall_height(*height, fields.path("fall_height"));
  }
  return contact;
}

}  // namespace clca::scene
