// Stages: what happens one after the other.

#include "document/internal/document.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

void check_stage(const KeyedMap& fields, Stage& stage) {
  if (fields.find("insert") != nullptr) {
    stage.insert_location = reference(fields.at("insert"));
  }
  const automaton::Rules& rules = stage.rules ? *stage.rules : fields.scene.rules;
  if (stage.fill && stage.fill->method == FillMethod::deposition &&
      rules.gravity != lattice::Direction::down) {
    fail(fields.at("fill").at("method"), "deposition needs rules.gravity: down");
  }
  check_until(fields, stage);
}

Map<Stage> stage_map() {
  const auto walls = references("wall", [](const Scene& scene) { return names_of(scene.walls); });
  const auto sources =
      references("source", [](const Scene& scene) { return names_of(scene.sources); });
  return {
      .keys = {required("name", &Stage::name, name_type(), "unique; part of the names of files"),
               key("fill", &Stage::fill, fill_type(),
                   "particles placed at the start: [fill](#fill)")
                   .defaults_to("none"),
               list_key("remove", &Stage::remove, walls, "walls to take away at the start"),
               list_key("insert", &Stage::insert, walls,
                        "walls to put in at the start; they are absent until then"),
               list_key("move", &Stage::move, walls,
                        "walls in motion during this stage; all others stand"),
               list_key("sources", &Stage::sources, sources,
                        "sources that are open during this stage; all others are closed"),
               key("vessel", &Stage::vessel, vessel_type(),
                   "how the [vessel](#vessel) stands and moves")
                   .of(Model::contact)
                   .defaults_to("none: it rests as it stands"),
               key("rules", &Stage::rules, stage_rules_type(),
                   "during this stage in place of those of the scene")
                   .of(Model::automaton)
                   .defaults_to("[rules](#rules)"),
               key("contact", &Stage::contact, stage_contact_type(),
                   "friction and restitution during this stage in place of those of the scene")
                   .of(Model::contact)
                   .defaults_to("[contact](#contact)"),
               key("until", &Stage::until, until_type(), "when the stage ends"),
               key("max_steps", &Stage::max_steps, count(1, kMaxSteps),
                   "ends the stage in any case")},
      .check = check_stage};
}

}  // namespace

std::string stage_path(const Value& value, std::size_t number) {
  const Value* name = value.find("name");
  return name != nullptr && name->is(Value::Kind::scalar)
             ? join_path("stages", name->text.substr(0, document::kMaxNameLength))
             : fmt::format("stages.{}", number);
}

Type<std::vector<Stage>> stages_type() {
  auto type = list_of(type_of(stage_map()), 1, kMaxItems, [](const Place& item, std::size_t index) {
    return stage_path(item.value, index);
  });
  type.allowed = fmt::format("list of 1 to {} maps", kMaxItems);
  type.text_of = [text = type.text_of](const void* stages, const Scene& scene) {
    Value list = text(stages, scene);
    list.in_lines = true;
    return list;
  };
  return type;
}

}  // namespace clca::scene
