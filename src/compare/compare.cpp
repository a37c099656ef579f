#include "clca/compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/run/run.hpp"
#include "clca/statistics/distribution.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/table.hpp"
#include "compare/read_runs.hpp"

namespace clca::compare {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "comparison";
constexpr const char* kComparison = "comparison.csv";
constexpr const char* kDistances = "distances.csv";

bool is_of_automaton(const Distribution& distribution) {
  return distribution.name.starts_with("automaton");
}

double noise_floor(const Distribution& of) {
  return statistics::hellinger_floor(of.shares.size(), of.samples);
}

std::vector<double> equal_shares(std::size_t bins) {
  std::vector<double> shares(bins, 1 / static_cast<double>(bins));
  return shares;
}

std::string comparison_csv(const Comparison& comparison) {
  std::vector<std::string> columns = {"quantile_lower", "quantile_upper"};
  for (const Distribution& distribution : comparison.distributions) {
    columns.push_back(distribution.name);
  }
  columns.emplace_back("reference");
  store::Table table(columns);
  const std::vector<double> reference = equal_shares(comparison.distributions[0].shares.size());
  const auto bins = static_cast<double>(reference.size());
  for (std::size_t bin = 0; bin < reference.size(); ++bin) {
    const auto number = static_cast<double>(bin);
    std::vector<store::Cell> row = {number / bins, (number + 1) / bins};
    for (const Distribution& distribution : comparison.distributions) {
      row.emplace_back(distribution.shares[bin]);
    }
    row.emplace_back(reference[bin]);
    table.add_row(std::move(row));
  }
  return table.to_csv();
}

std::string distances_csv(const Comparison& comparison) {
  store::Table table({"name", "distance", "floor", "samples"});
  for (const Distance& distance : distances(comparison)) {
    table.add_row({distance.name, distance.distance, distance.floor, distance.samples});
  }
  return table.to_csv();
}

double from_chi_square(const Distribution& distribution) {
  return statistics::hellinger_distance(distribution.shares,
                                        equal_shares(distribution.shares.size()));
}

/// Lets figures be drawn of the folder as of a run.
store::RunSummary summary(const Comparison& comparison) {
  store::RunSummary summary = run::provenance();
  summary.kind = kKind;
  summary.scene = comparison.title;
  summary.status = "done";
  store::StageSummary stage = {.name = comparison.stage, .steps = 0, .ended = "", .measures = {}};
  for (const Distribution& distribution : comparison.distributions) {
    stage.measures.emplace_back("hellinger_" + distribution.name, from_chi_square(distribution));
  }
  summary.stages.push_back(stage);
  return summary;
}

/// Does not overwrite the run.json of a run.
void refuse_run(const fs::path& folder) {
  if (!fs::exists(folder / "run.json")) {
    return;
  }
  const std::string kind = store::read_summary(folder / "run.json").kind;
  if (kind != kKind) {
    throw CompareError(
        fmt::format("{}: there is a run of kind {} in it; write the comparison elsewhere",
                    folder.string(), kind));
  }
}

}  // namespace

Comparison comparison(const fs::path& automaton_run, const fs::path& boltzmann_run,
                      const RunChoice& choice) {
  const AutomatonSide automaton = read_automaton(automaton_run, choice);
  const BoltzmannSide gas = read_boltzmann(boltzmann_run, choice);
  Comparison result = {.title = fmt::format("{}, {}, and {} at {}", automaton.scene,
                                            automaton.stage, gas.scene, gas.time),
                       .stage = automaton.stage,
                       .time = gas.time,
                       .distributions = automaton.distributions};
  result.distributions.insert(result.distributions.end(), gas.distributions.begin(),
                              gas.distributions.end());
  const std::size_t bins = result.distributions[0].shares.size();
  for (const Distribution& distribution : result.distributions) {
    if (distribution.samples == 0) {
      throw CompareError(fmt::format("{}: there are no particles", boltzmann_run.string()));
    }
    if (distribution.shares.size() != bins || bins < 2) {
      throw CompareError(fmt::format(
          "{}: the {} energy is in {} bins, that of the automaton in {} (bins: q20 in the scene)",
          boltzmann_run.string(), distribution.name, distribution.shares.size(), bins));
    }
  }
  return result;
}

std::vector<Distance> distances(const Comparison& comparison) {
  std::vector<Distance> result;
  for (const Distribution& distribution : comparison.distributions) {
    result.push_back({distribution.name, from_chi_square(distribution), noise_floor(distribution),
                      distribution.samples});
  }
  for (const Distribution& one : comparison.distributions) {
    for (const Distribution& other : comparison.distributions) {
      if (is_of_automaton(one) && !is_of_automaton(other)) {
        result.push_back(
            {one.name + ":" + other.name, statistics::hellinger_distance(one.shares, other.shares),
             noise_floor(one) + noise_floor(other), std::min(one.samples, other.samples)});
      }
    }
  }
  return result;
}

void write(const Comparison& comparison, const fs::path& folder) {
  refuse_run(folder);
  const store::OutputFolder files(folder);
  for (const char* name : {kComparison, kDistances, store::kSummaryFile}) {
    files.require_free(name);
  }
  files.write(kComparison, comparison_csv(comparison));
  files.write(kDistances, distances_csv(comparison));
  files.write(store::kSummaryFile, store::to_json(summary(comparison)));
}

}  // namespace clca::compare
