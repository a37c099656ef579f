// The contact model and its units.

#include <fmt/format.h>

#include <algorithm>

#include "clca/text/message.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

int read_sweeps(const KeyedMap& fields, int otherwise) {
  const int sweeps = fields.integer("sweeps", kMinSweeps, kMaxSweeps, otherwise);
  if (sweeps % 2 != 0) {
    fail(fields.at("sweeps").location,
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
    fail(value.location, fmt::format("{}: expected {} or a number above 0 and up to {}, found {}{}",
                                     path, kAutoHeight, kMaxFallHeight, found(value),
                                     text::suggestion(value.text, kWords)));
  }
  return read_positive(value, path, kMaxFallHeight);
}

/// `1 mm` in metres.
double read_length(const Value& value, const std::string& path) {
  const std::size_t end = value.text.find_last_of("0123456789.") + 1;
  const std::size_t unit_begin =
      std::min(value.text.find_first_not_of(' ', end), value.text.size());
  const std::string_view text = value.text;
  const auto number = to_number(text.substr(0, end));
  for (const Named<double>& unit : kLengthUnits) {
    const double length = number.value_or(0) / unit.value;
    if (text.substr(unit_begin) == unit.name && length >= kMinSpacing && length <= kMaxSpacing) {
      return length;
    }
  }
  fail(value.location,
       fmt::format("{}: expected a length from {} m to {} m, a number with one of the units {}, as "
                   "in 1 mm, found {}",
                   path, kMinSpacing, kMaxSpacing, fmt::join(words(kLengthUnits), ", "),
                   found(value)));
}

}  // namespace

Units read_units(const Value& value) {
  const KeyedMap fields(value, "units", kUnitsKeys);
  Units units;
  units.spacing = read_length(fields.at("spacing"), fields.path("spacing"));
  units.gravity = fields.number("gravity", kMinRealGravity, kMaxRealGravity, units.gravity);
  return units;
}

contact::Parameters read_contact(const Value& value) {
  const KeyedMap fields(value, "contact", kContactModelKeys);
  contact::Parameters contact;
  contact.friction = fields.number("friction", 0, kMaxContactFriction, contact.friction);
  contact.wall_friction =
      fields.number("wall_friction", 0, kMaxContactFriction, contact.wall_friction);
  contact.rolling = fields.choice("rolling", kRollingNames, contact.rolling);
  contact.rolling_friction =
      fields.number("rolling_friction", 0, kMaxContactFriction, contact.rolling_friction);
  contact.restitution =
      fields.number("restitution", 0, kMaxContactRestitution, contact.restitution);
  contact.sweeps = read_sweeps(fields, contact.sweeps);
  contact.resolution =
      fields.number("resolution", kMinResolution, kMaxResolution, contact.resolution);
  if (const Value* height = fields.find("fall_height")) {
    contact.fall_height = read_fall_height(*height, fields.path("fall_height"));
  }
  contact.sleeping = fields.boolean("sleeping", contact.sleeping);
  return contact;
}

}  // namespace clca::scene
