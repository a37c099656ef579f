// How the vessel stands and moves in a stage.

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

/// An angle, or a map with the angle and how fast it is reached.
Type<Tilt> tilt() {
  const Type<double> angle = number(-kMaxTilt, kMaxTilt);
  auto rate = key("rate", &Tilt::rate, above_zero(kMaxVesselRate), "degrees per unit of time");
  rate.required = true;
  const Type<Tilt> turn =
      type_of<Tilt>({.keys = {required("to", &Tilt::to, angle, "degrees"), rate}});
  auto type = own_type<Tilt>(
      angle.allowed + ", or map", any_of({angle.schema, turn.schema}),
      [=](const Value& value, const std::string& path, const Scene& scene) {
        return value.is(Value::Kind::map) ? turn.read(value, path, scene)
                                          : Tilt{.to = angle.read(value, path, scene), .rate = {}};
      },
      [=](const Tilt& tilt, const Scene& scene) {
        return tilt.rate ? turn.text(tilt, scene) : angle.text(tilt.to, scene);
      });
  type.keys = turn.keys;
  return type;
}

Type<Rotate> rotate() {
  return type_of<Rotate>(
      {.keys = {required("rate", &Rotate::rate, number(-kMaxVesselRate, kMaxVesselRate),
                         "turns per unit of time: anticlockwise, or clockwise below 0"),
                key("centre", &Rotate::centre, point(), "what it turns about")
                    .defaults_to("the middle of the box")},
       .check = [](const KeyedMap& fields, Rotate& rotate, const Scene& scene) {
         if (scene.box.periodic) {
           fail(fields.location(),
                fmt::format("{}: a periodic box has no centre to turn about; say 'periodic: false'",
                            fields.path()));
         }
         if (rotate.rate == 0) {
           fail(fields.at("rate").location,
                fmt::format("{}: expected a rate other than 0", fields.path("rate")));
         }
       }});
}

Type<VesselShake> vessel_shake() {
  return type_of<VesselShake>(
      {.keys = {required("gamma", &VesselShake::gamma, above_zero(kMaxGamma),
                         "greatest acceleration over that of gravity"),
                required("amplitude", &VesselShake::amplitude, above_zero(kMaxShakeAmplitude),
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
