#include "clca/store/summary.hpp"

#include <fmt/format.h>

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

Json to_object(const StageSummary& stage) {
  Json measures = Json::object();
  for (const auto& [name, value] : stage.measures) {
    measures[name] = to_value(value);
  }
  return {{"name", stage.name},
          {"steps", stage.steps},
          {"ended", stage.ended},
          {"measures", std::move(measures)}};
}

}  // namespace

const char* rate_key(std::string_view kind) {
  return kind == "boltzmann" ? "collisions_per_second" : "particle_updates_per_second";
}

std::string to_json(const RunSummary& summary) {
  Json stages = Json::array();
  for (const StageSummary& stage : summary.stages) {
    stages.push_back(to_object(stage));
  }
  const Json object = {{"clca", summary.version},
                       {"kind", summary.kind},
                       {"scene", summary.scene},
                       {"seed", summary.seed},
                       {"threads", summary.threads},
                       {"status", summary.status},
                       {"particles", summary.particles},
                       {"steps", summary.steps},
                       {"wall_seconds", summary.wall_seconds},
                       {"step_seconds", summary.step_seconds},
                       {rate_key(summary.kind), summary.rate},
                       {"state_hash", fmt::format("{:016x}", summary.state_hash)},
                       {"build", {{"compiler", summary.compiler}, {"type", summary.build_type}}},
                       {"stages", std::move(stages)}};
  constexpr int kIndent = 2;
  return object.dump(kIndent) + '\n';
}

}  // namespace clca::store
