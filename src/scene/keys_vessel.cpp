// How the vessel stands and moves in a stage.

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

/// An angle, or a map with the angle and how fast it is reached.
Type<Tilt> tilt() {
  const Type<double> angle = number(-kMaxTilt, kMaxTilt);
  const auto turn = type_of<Tilt>(
      {.keys = {required("to", &Tilt::to, angle, "degrees"),
                key("rate", &Tilt::rate, above_zero(kMaxVesselRate), "degrees per unit of time")
                    .is_required()}});
  return or_map(
      angle.allowed, angle.schema, turn,
      [=](const Place& place) { return Tilt{.to = angle.read(place), .rate = {}}; },
      [](const Tilt& tilt) {
        return tilt.rate ? std::nullopt : std::optional(Value::number(tilt.to));
      });
}

Type<Rotate> rotate() {
  return type_of<Rotate>(
      {.keys = {required("rate", &Rotate::rate, number(-kMaxVesselRate, kMaxVesselRate),
                         "turns per unit of time: anticlockwise, or clockwise below 0"),
                key("centre", &Rotate::centre, point(), "what it turns about")
                    .defaults_to("the middle of the box")},
       .check = [](const KeyedMap& fields, Rotate& rotate) {
         if (fields.scene.box.periodic) {
           fail(fields, "a periodic box has no centre to turn about; say 'periodic: false'");
         }
         if (rotate.rate == 0) {
           fail(fields.at("rate"), "expected a rate other than 0");
         }
       }});
}

Type<VesselShake> vessel_shake() {
  return type_of<VesselShake>(
      {.keys = {required("gamma", &VesselShake::gamma, above_zero(1000),
                         "greatest acceleration over that of gravity"),
                required("amplitude", &VesselShake::amplitude, length(above_zero(1000)),
                         "spacings to either side"),
                key("direction", &VesselShake::sideways, choice(kShakeDirectionNames),
                    "along gravity, beginning upwards, or across it, beginning to the right")}});
}

}  // namespace

Type<VesselMotion> vessel_type() {
  return one_of<VesselMotion>(
      {alternative<VesselMotion>("tilt", tilt(),
                                 "stands at this angle from upright, in degrees anticlockwise: at "
                                 "once, or turned to it the shorter way"),
       alternative<VesselMotion>("rotate", rotate(), "turns without end"),
       alternative<VesselMotion>("shake", vessel_shake(), "swings as a sine")});
}

}  // namespace clca::scene
