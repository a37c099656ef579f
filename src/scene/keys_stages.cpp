// Stages: what happens one after the other, how the vessel stands and moves, when a stage ends.

#include <algorithm>

#include "clca/contact/state.hpp"
#include "clca/scene/units.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMaxVesselRate = 1e6;  // degrees of a tilt, or turns, per unit of time

/// An angle, or a map with the angle and how fast it is reached.
Type<Tilt> tilt() {
  const Type<double> angle = number_type(-180, 180);
  const auto turn =
      type_of<Tilt>({.keys = {required_key("to", &Tilt::to_degrees, angle, "degrees"),
                              key("rate", &Tilt::degrees_per_time, positive_type(kMaxVesselRate),
                                  "degrees per unit of time")
                                  .mark_required()}});
  return or_map(
      angle.allowed, angle.schema, turn,
      [=](const PlacedValue& place) {
        return Tilt{.to_degrees = angle.read(place), .degrees_per_time = {}};
      },
      [](const Tilt& tilt) {
        return tilt.degrees_per_time ? std::nullopt : std::optional(Value::number(tilt.to_degrees));
      });
}

Type<Rotate> rotate() {
  return type_of<Rotate>(
      {.keys = {required_key("rate", &Rotate::turns_per_time,
                             number_type(-kMaxVesselRate, kMaxVesselRate),
                             "turns per unit of time: anticlockwise, or clockwise below 0"),
                key("centre", &Rotate::centre, point_type(), "what it turns about")
                    .defaults_to("the middle of the box")},
       .check = [](const PlacedValue& fields, Rotate& rotate) {
         if (fields.scene.box.periodic) {
           fail(fields, "a periodic box has no centre to turn about; say 'periodic: false'");
         }
         if (rotate.turns_per_time == 0) {
           fail(fields.at("rate"), "expected a rate other than 0");
         }
       }});
}

Type<VesselShake> vessel_shake() {
  return type_of<VesselShake>(
      {.keys = {required_key("gamma", &VesselShake::gamma, positive_type(1000),
                             "greatest acceleration over that of gravity"),
                required_key("amplitude", &VesselShake::amplitude, length_type(positive_type(1000)),
                             "spacings to either side"),
                key("direction", &VesselShake::sideways, choice_type(kShakeDirectionNames),
                    "along gravity, beginning upwards, or across it, beginning to the right")}});
}

/// The first periodic wall of the stage; null if there is none.
const Wall* cyclic_wall(const Stage& stage, const Scene& scene) {
  for (const std::size_t wall : stage.moving_walls) {
    if (scene.walls[wall].motion && grains::is_cyclic(*scene.walls[wall].motion)) {
      return &scene.walls[wall];
    }
  }
  return nullptr;
}

/// Rounded up; at most kMaxSteps + 1.
std::uint64_t steps_in_bounds(double steps) {
  return static_cast<std::uint64_t>(std::min(std::ceil(steps), static_cast<double>(kMaxSteps + 1)));
}

/// Minimum steps of a cycle of the wall; 0 without cycles.
std::uint64_t min_cycle_steps(const Wall& wall, Model model) {
  if (!wall.motion) {
    return 0;
  }
  if (const auto* wave = std::get_if<grains::Wave>(&wall.motion->program)) {
    return wave->period;
  }
  const auto* shake = std::get_if<grains::Shake>(&wall.motion->program);
  if (shake == nullptr) {
    return 0;
  }
  const bool is_contact = model == Model::contact;
  return 2 * static_cast<std::uint64_t>(shake->amplitude) *
             (is_contact ? shake->contact_period() : 1) +
         shake->wait.value_or(is_contact ? contact::kSettlingSteps : 0);
}

/// Why particles never come to rest in this stage, apart from walls; empty if they do.
std::string why_never_at_rest(const Stage& stage, const Scene& scene) {
  const automaton::Rules& rules =
      stage.automaton_rules ? *stage.automaton_rules : scene.automaton_rules;
  if (rules.candidates == automaton::CandidateDirections::all) {
    return "with rules.candidates: all";
  }
  const lattice::Direction gravity = rules.gravity;
  if (scene.box.periodic && gravity != lattice::Direction::down &&
      gravity != lattice::Direction::up) {
    return "with a sideways rules.gravity in a periodic box";
  }
  for (const std::size_t source : stage.open_sources) {
    if (!scene.sources[source].max_particles) {
      return fmt::format("while source '{}' is open, which has no count",
                         scene.sources[source].name);
    }
  }
  return {};
}

/// Why a stage until settled would never end, and a remedy; empty if it ends.
std::string why_endless(const Stage& stage, const Scene& scene) {
  if (const Wall* wall = cyclic_wall(stage, scene)) {
    return fmt::format(
        "while wall '{}' goes to and fro; end the stage after cycles or steps, or give max_steps",
        wall->name);
  }
  if (vessel_has_cycles(stage)) {
    return fmt::format(
        "while the vessel {}; end the stage after cycles or steps, or give max_steps",
        std::holds_alternative<Rotate>(*stage.vessel_motion) ? "turns" : "is shaken");
  }
  const std::string reason = why_never_at_rest(stage, scene);
  return reason.empty() ? reason : reason + "; give max_steps";
}

/// Rejects cycles of a shake that waits for rest that never comes.
void check_waits(const Stage& stage, const PlacedValue& until) {
  const Scene& scene = until.scene;
  const std::string reason = why_never_at_rest(stage, scene);
  for (const std::size_t number : stage.moving_walls) {
    const Wall& wall = scene.walls[number];
    const auto* shake = wall.motion ? std::get_if<grains::Shake>(&wall.motion->program) : nullptr;
    if (shake != nullptr && !shake->wait && !reason.empty()) {
      fail(until,
           "wall '{}' waits until all is settled, which never comes {}; give its shake a wait "
           "in steps, or give max_steps",
           wall.name, reason);
    }
  }
}

/// Refuses ends that can never come.
void check_until(const PlacedValue& fields, const Stage& stage) {
  const Scene& scene = fields.scene;
  const Value* given = fields.find("until");
  const PlacedValue until = {given != nullptr ? *given : fields.value,
                             join_path(fields.path, "until"), scene};
  const bool cycles = std::holds_alternative<UntilCycles>(stage.until);
  if (cycles && cyclic_wall(stage, scene) == nullptr && !vessel_has_cycles(stage)) {
    fail(until,
         "no wall of this stage goes to and fro{}; name one with a wave or a shake under move",
         scene.model == Model::contact ? ", and its vessel neither turns nor is shaken" : "");
  }
  if (std::holds_alternative<UntilDischarged>(stage.until) && scene.outlets.empty()) {
    fail(until, "nothing can be discharged, the scene has no outlets");
  }
  if (fields.find("max_steps") != nullptr) {
    return;
  }
  if (std::holds_alternative<UntilSettled>(stage.until)) {
    if (const std::string reason = why_endless(stage, scene); !reason.empty()) {
      fail(until, "never comes to rest {}", reason);
    }
  }
  if (cycles) {
    check_waits(stage, until);
  }
}

/// `{steps: N}` and so on: every `until` but the word `settled`.
Type<EndCondition> until_map_type() {
  const auto end = [](std::string_view name, const auto& type, std::string_view about) {
    return alternative_key<EndCondition>(name, type, about);
  };
  return one_of_type<EndCondition>(
      {end("steps", member_type(&UntilSteps::steps, count_type(1, kMaxSteps)),
           "after N steps, at rest or not"),
       end("discharged", member_type(&UntilDischarged::discharged_share, positive_type(1)),
           "when this share of the particles has left through the outlets"),
       end("cycles", member_type(&UntilCycles::cycles, count_type(1, kMaxSteps)),
           "after so many cycles of each wall with a wave or a shake, and of a vessel that turns "
           "or is shaken"),
       end("time", member_type(&UntilTime::time, positive_type(kMaxTime)),
           "after this time: in seconds where the scene has [`units`](#units), else in "
           "√(spacing/gravity)")
           .of(Model::contact)});
}

UntilSettled read_settled(const PlacedValue& place) {
  constexpr std::array<std::string_view, 1> kSettled = {"settled"};
  if (place.value.text != kSettled.front()) {
    fail(place,
         "expected settled, {{steps: N}}, {{discharged: SHARE}}, {{cycles: N}} or {{time: T}}, "
         "found {}{}",
         found(place), text::suggestion(place.value.text, kSettled));
  }
  return {};
}

Type<VesselMotion> vessel_type() {
  return one_of_type<VesselMotion>(
      {alternative_key<VesselMotion>(
           "tilt", tilt(),
           "stands at this angle from upright, in degrees anticlockwise: at "
           "once, or turned to it the shorter way"),
       alternative_key<VesselMotion>("rotate", rotate(), "turns without end"),
       alternative_key<VesselMotion>("shake", vessel_shake(), "swings as a sine")});
}

Type<EndCondition> until_type() {
  return or_map("`settled`", word_schema("settled"), until_map_type(), read_settled,
                [](const EndCondition& until) {
                  return std::holds_alternative<UntilSettled>(until)
                             ? std::optional(Value::scalar("settled"))
                             : std::nullopt;
                });
}

void check_stage(const PlacedValue& fields, Stage& stage) {
  if (fields.find("insert") != nullptr) {
    stage.insert_location = location_text(fields.at("insert"));
  }
  const automaton::Rules& rules =
      stage.automaton_rules ? *stage.automaton_rules : fields.scene.automaton_rules;
  if (stage.fill && stage.fill->method == FillMethod::deposition &&
      rules.gravity != lattice::Direction::down) {
    fail(fields.at("fill").at("method"), "deposition needs rules.gravity: down");
  }
  check_until(fields, stage);
}

Map<Stage> stage_map() {
  const auto walls =
      references_type("wall", [](const Scene& scene) { return names_of(scene.walls); });
  const auto sources =
      references_type("source", [](const Scene& scene) { return names_of(scene.sources); });
  return {
      .keys = {required_key("name", &Stage::name, name_type(),
                            "unique; part of the names of files"),
               key("fill", &Stage::fill, fill_type(),
                   "particles placed at the start: [fill](#fill)")
                   .defaults_to("none"),
               list_key("remove", &Stage::removed_walls, walls, "walls to take away at the start"),
               list_key("insert", &Stage::inserted_walls, walls,
                        "walls to put in at the start; they are absent until then"),
               list_key("move", &Stage::moving_walls, walls,
                        "walls in motion during this stage; all others stand"),
               list_key("sources", &Stage::open_sources, sources,
                        "sources that are open during this stage; all others are closed"),
               key("vessel", &Stage::vessel_motion, vessel_type(),
                   "how the [vessel](#vessel) stands and moves")
                   .of(Model::contact)
                   .defaults_to("none: it rests as it stands"),
               key("rules", &Stage::automaton_rules, stage_rules_type(),
                   "during this stage in place of those of the scene")
                   .of(Model::automaton)
                   .defaults_to("[rules](#rules)"),
               key("contact", &Stage::contact_parameters, stage_contact_type(),
                   "friction and restitution during this stage in place of those of the scene")
                   .of(Model::contact)
                   .defaults_to("[contact](#contact)"),
               key("until", &Stage::until, until_type(), "when the stage ends"),
               key("max_steps", &Stage::max_steps, count_type(1, kMaxSteps),
                   "ends the stage in any case")},
      .check = check_stage};
}

}  // namespace

std::uint64_t least_steps(const Stage& stage, const Scene& scene) {
  if (const auto steps = fixed_steps(stage.until)) {
    return *steps;
  }
  const auto* cycles = std::get_if<UntilCycles>(&stage.until);
  if (cycles == nullptr) {
    return 0;
  }
  double longest = 0;
  for (const std::size_t wall : stage.moving_walls) {
    longest =
        std::max(longest, static_cast<double>(min_cycle_steps(scene.walls[wall], scene.model)));
  }
  if (vessel_has_cycles(stage)) {
    const contact::Vessel vessel = vessel_at_start(scene, stage, {});
    longest = std::max(longest, 0x1p64 / static_cast<double>(vessel.phase_step));
  }
  return steps_in_bounds(static_cast<double>(cycles->cycles) * longest);
}

void set_max_steps(Scene& scene, const Value& list) {
  for (std::size_t number = 0; number < scene.stages.size(); ++number) {
    Stage& stage = scene.stages[number];
    const PlacedValue fields = {list.items[number], join_path("stages", stage.name), scene};
    if (auto* until = std::get_if<UntilTime>(&stage.until)) {
      until->steps = steps_in_bounds(steps_until(until->time, *unit_conversion(scene)));
    }
    const std::uint64_t least = least_steps(stage, scene);
    if (least > kMaxSteps) {
      fail(fields.at("until"), "it takes more than {} steps", kMaxSteps);
    }
    if (fields.find("max_steps") != nullptr && stage.max_steps < least) {
      fail(fields.at("max_steps"), "{} is less than the {} steps of until", stage.max_steps, least);
    }
    stage.max_steps = std::max(stage.max_steps, least);
  }
}

std::string stage_path(const Value& value, std::size_t number) {
  const Value* name = value.find("name");
  return name != nullptr && name->is(Value::Kind::scalar)
             ? join_path("stages", name->text.substr(0, document::kMaxNameLength))
             : fmt::format("stages.{}", number);
}

Type<std::vector<Stage>> stages_type() {
  auto type = list_type(
      type_of(stage_map()), 1, kMaxItems,
      [](const PlacedValue& item, std::size_t index) { return stage_path(item.value, index); });
  type.allowed = fmt::format("list of 1 to {} maps", kMaxItems);
  type.text_of = [text = type.text_of](const void* stages, const Scene& scene) {
    Value list = text(stages, scene);
    list.one_entry_per_line = true;
    return list;
  };
  return type;
}

}  // namespace clca::scene
