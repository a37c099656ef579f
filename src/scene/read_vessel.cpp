// How the vessel stands and moves in a stage.

#include <fmt/format.h>

#include "clca/contact/vessel.hpp"
#include "scene/keyed_map.hpp"
#include "scene/limits.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// An angle, or a map with the angle and how fast it is reached.
Tilt read_tilt(const Value& value, const std::string& path) {
  if (!value.is(Value::Kind::map)) {
    return {.to = read_number(value, path, -kMaxTilt, kMaxTilt), .rate = {}};
  }
  const KeyedMap fields(value, path, kTiltKeys);
  return {.to = fields.number("to", -kMaxTilt, kMaxTilt),
          .rate = fields.positive("rate", kMaxVesselRate)};
}

Rotate read_rotate(const Value& value, const std::string& path, const Box& box) {
  const KeyedMap fields(value, path, kRotateKeys);
  if (box.periodic) {
    fail(value.location,
         fmt::format("{}: a periodic box has no centre to turn about; say 'periodic: "
                     "false'",
                     path));
  }
  Rotate rotate;
  rotate.rate = fields.number("rate", -kMaxVesselRate, kMaxVesselRate);
  if (rotate.rate == 0) {
    fail(fields.at("rate").location,
         fmt::format("{}: expected a rate other than 0", fields.path("rate")));
  }
  if (const Value* centre = fields.find("centre")) {
    rotate.centre = read_point(*centre, fields.path("centre"));
  }
  return rotate;
}

VesselShake read_vessel_shake(const Value& value, const std::string& path) {
  const KeyedMap fields(value, path, kVesselShakeKeys);
  return {.gamma = fields.positive("gamma", kMaxGamma),
          .amplitude = fields.positive("amplitude", kMaxShakeAmplitude),
          .sideways = fields.choice("direction", kShakeDirectionNames, false)};
}

}  // namespace

VesselMotion read_vessel(const Value& value, const std::string& path, const Box& box) {
  const KeyedMap fields(value, path, kVesselKeys);
  const std::string_view key = fields.only({"tilt", "rotate", "shake"});
  if (key == "tilt") {
    return read_tilt(fields.at(key), fields.path(key));
  }
  if (key == "rotate") {
    return read_rotate(fields.at(key), fields.path(key), box);
  }
  return read_vessel_shake(fields.at(key), fields.path(key));
}

}  // namespace clca::scene
