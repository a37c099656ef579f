#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "clca/scene/format.hpp"
#include "compare/histogram.hpp"
#include "compare/read_runs.hpp"

namespace clca::compare {

namespace {

namespace fs = std::filesystem;

fs::path fluctuation_file(const fs::path& run, const std::string& stage) {
  return run / fmt::format("fluctuation-{}.csv", stage);
}

const store::StageSummary& chosen_stage(const fs::path& run, const store::RunSummary& summary,
                                        const std::optional<std::string>& wanted) {
  const store::StageSummary* chosen = nullptr;
  std::vector<std::string> names;
  for (const store::StageSummary& stage : summary.stages) {
    if (fs::exists(fluctuation_file(run, stage.name))) {
      names.push_back(stage.name);
      chosen = !wanted || stage.name == *wanted ? &stage : chosen;
    }
  }
  if (names.empty()) {
    throw CompareError(
        fmt::format("{}: no stage has a fluctuation table; the scene needs output.fields with a "
                    "window that a stage is long enough for",
                    run.string()));
  }
  if (chosen == nullptr) {
    throw CompareError(fmt::format("{}: no fluctuation table of a stage '{}'; there are {}",
                                   run.string(), *wanted, fmt::join(names, ", ")));
  }
  return *chosen;
}

std::uint64_t sample_count(const fs::path& run, const store::StageSummary& stage) {
  for (const auto& [name, value] : stage.measures) {
    const auto* samples = std::get_if<double>(&value);
    if (name == "fluctuation_samples" && samples != nullptr && *samples >= 1 && *samples < 0x1p64) {
      return static_cast<std::uint64_t>(*samples);
    }
  }
  throw CompareError(fmt::format("{}: stage {} has no measure fluctuation_samples",
                                 (run / "run.json").string(), stage.name));
}

}  // namespace

AutomatonSide read_automaton(const fs::path& run, const RunChoice& choice) {
  const store::RunSummary summary = read_run(run, scene::words_of("model"));
  const store::StageSummary& stage = chosen_stage(run, summary, choice.stage);
  const Histogram table(fluctuation_file(run, stage.name));
  const std::uint64_t samples = sample_count(run, stage);
  return {.scene = summary.scene,
          .stage = stage.name,
          .distributions = {{"automaton", table.shares("share"), samples},
                            {"automaton_local", table.shares("share_local"), samples}}};
}

}  // namespace clca::compare
