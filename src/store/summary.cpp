#include "clca/store/summary.hpp"

#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>

namespace clca::store {

namespace {

using Json = nlohmann::ordered_json;

Json to_value(const MeasureValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return *number;
  }
  if (const auto* answer = std::get_if<bool>(&value)) {
    return *answer;
  }
  return nullptr;
}

Json to_object(const scene::Conversion& units) {
  Json object = {{"length", units.length_unit},
                 {"time", units.time_unit},
                 {"velocity", units.velocity_unit},
                 {"spacing", units.spacing},
                 {"time_step", units.time_step}};
  if (units.site) {
    object["site_mass"] = units.site->mass;
    object["site_weight"] = units.site->weight;
  }
  return object;
}

Json to_object(const BoxSummary& box) {
  return {{"left", box.left},
          {"right", box.right},
          {"floor", box.floor},
          {"top", box.top},
          {"periodic", box.periodic}};
}

Json to_object(const BeginSummary& begin) {
  return {{"run", begin.run},
          {"step", begin.step ? Json(*begin.step) : Json("last")},
          {"state_hash", fmt::format("{:016x}", begin.state_hash)}};
}

Json to_object(const std::vector<scene::DerivedMeasure>& derived) {
  Json object = Json::object();
  for (const scene::DerivedMeasure& measure : derived) {
    object[measure.name] = {{"value", measure.value}, {"unit", measure.unit}};
    if (measure.about) {
      object[measure.name]["about"] = *measure.about;
    }
  }
  return object;
}

/// The simulated time, if steps have a length.
void add_time(Json& object, std::uint64_t steps, const std::optional<scene::Conversion>& units) {
  if (units) {
    object["time"] = units->time(steps);
  }
}

Json to_object(const StageSummary& stage, const std::optional<scene::Conversion>& units) {
  Json measures = Json::object();
  for (const auto& [name, value] : stage.measures) {
    measures[name] = to_value(value);
  }
  Json object = {{"name", stage.name}, {"steps", stage.steps}};
  add_time(object, stage.steps, units);
  object["ended"] = stage.ended;
  object["measures"] = std::move(measures);
  if (stage.fills) {
    object["fills"] = true;
  }
  if (!stage.notes.empty()) {
    object["notes"] = stage.notes;
  }
  return object;
}

Json to_object(const KindSummary& kind) {
  return {{"species", kind.species}, {"degrees", kind.degrees}};
}

Json to_object(const ColumnSummary& column) {
  Json object = {{"key", column.key}, {"name", column.name}};
  for (const auto& [key, text] :
       {std::pair("of", column.of), {"unit", column.unit}, {"meaning", column.meaning}}) {
    if (!text.empty()) {
      object[key] = text;
    }
  }
  if (column.of_floor) {
    object["of_floor"] = true;
  }
  return object;
}

template <class Item>
Json list_of(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) {
    list.push_back(to_object(item));
  }
  return list;
}

}  // namespace

Json to_list(const std::vector<ColumnSummary>& measures) {
  return list_of(measures);
}

Json to_object(const std::vector<TableSummary>& tables) {
  Json object = Json::object();
  for (const auto& [name, columns] : tables) {
    object[name] = to_list(columns);
  }
  return object;
}

const char* rate_key(std::string_view kind) {
  return kind == "boltzmann" ? "collisions_per_second" : "particle_updates_per_second";
}

std::string to_json(const RunSummary& summary) {
  // Destructors of JSON values allocate, which must not fail: with no room for all, it fails here.
  constexpr std::size_t kRoom = 1'000'000;
  ::operator delete(::operator new(kRoom));
  Json stages = Json::array();
  for (const StageSummary& stage : summary.stages) {
    stages.push_back(to_object(stage, summary.units));
  }
  Json object = {
      {"clca", summary.version},  {"kind", summary.kind},           {"scene", summary.scene},
      {"title", summary.title},   {"seed", summary.seed},           {"threads", summary.threads},
      {"status", summary.status}, {"particles", summary.particles}, {"steps", summary.steps}};
  if (summary.ranks > 1) {
    object["ranks"] = summary.ranks;
  }
  add_time(object, summary.steps, summary.units);
  if (summary.begin) {
    object["begin"] = to_object(*summary.begin);
  }
  if (summary.units) {
    object["units"] = to_object(*summary.units);
  }
  if (summary.box) {
    object["box"] = to_object(*summary.box);
  }
  if (!summary.derived.empty()) {
    object["derived"] = to_object(summary.derived);
  }
  object["wall_seconds"] = summary.wall_seconds;
  object["step_seconds"] = summary.step_seconds;
  object[rate_key(summary.kind)] = summary.rate;
  object["state_hash"] = fmt::format("{:016x}", summary.state_hash);
  object["build"] = {{"compiler", summary.compiler}, {"type", summary.build_type}};
  object["stages"] = std::move(stages);
  object["kinds"] = list_of(summary.kinds);
  object["measures"] = to_list(summary.measures);
  object["tables"] = to_object(summary.tables);
  constexpr int kIndent = 2;
  return object.dump(kIndent) + '\n';
}

}  // namespace clca::store
