#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "compare/histogram.hpp"
#include "compare/read_runs.hpp"

namespace clca::compare {

namespace {

namespace fs = std::filesystem;

/// The files histogram-T.csv of a folder by their time.
std::map<double, fs::path> histogram_files(const fs::path& run) {
  constexpr std::string_view kStart = "histogram-";
  std::map<double, fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(run, error), end; !error && it != end; it.increment(error)) {
    const std::string stem = it->path().stem().string();
    if (it->path().extension() == ".csv" && stem.starts_with(kStart)) {
      if (const auto time = number(stem.substr(kStart.size()))) {
        files.emplace(*time, it->path());
      }
    }
  }
  if (error) {
    throw CompareError(fmt::format("cannot read the folder {}: {}", run.string(), error.message()));
  }
  return files;
}

std::pair<double, fs::path> chosen_histogram(const fs::path& run, std::optional<double> wanted) {
  const std::map<double, fs::path> files = histogram_files(run);
  if (files.empty()) {
    throw CompareError(fmt::format(
        "{}: it has no histogram-TIME.csv; the scene needs output.histograms", run.string()));
  }
  const auto chosen = wanted ? files.find(*wanted) : std::prev(files.end());
  if (chosen == files.end()) {
    std::vector<double> times;
    for (const auto& [time, file] : files) {
      times.push_back(time);
    }
    throw CompareError(fmt::format("{}: no histogram of time {}; there are {}", run.string(),
                                   *wanted, fmt::join(times, ", ")));
  }
  return *chosen;
}

/// Keeps the rows of one restitution where there is a column of them.
void choose_restitution(Histogram& table, std::optional<double> wanted) {
  if (!table.has("restitution")) {
    if (wanted) {
      table.fail("it has no column 'restitution' to choose from");
    }
    return;
  }
  const std::vector<std::string> all = table.texts("restitution");
  const std::set<std::string> texts(all.begin(), all.end());
  const auto chosen = wanted
                          ? std::find_if(texts.begin(), texts.end(),
                                         [&](const auto& text) { return number(text) == wanted; })
                          : texts.begin();
  if (chosen == texts.end() || (!wanted && texts.size() > 1)) {
    table.fail(
        fmt::format("choose one of the restitutions {} (--restitution)", fmt::join(texts, ", ")));
  }
  table.keep("restitution", *chosen);
}

std::vector<double> shares_of(Histogram table, const std::string& energy) {
  table.keep("energy", energy);
  return table.shares("share");
}

bool is_zero(const std::vector<double>& shares) {
  return std::all_of(shares.begin(), shares.end(), [](double share) { return share == 0; });
}

}  // namespace

BoltzmannSide read_boltzmann(const fs::path& run, const RunChoice& choice) {
  const store::RunSummary summary = read_run(run, {"boltzmann"});
  const auto [time, file] = chosen_histogram(run, choice.time);
  Histogram table(file);
  choose_restitution(table, choice.restitution);
  BoltzmannSide side = {.scene = summary.scene,
                        .time = time,
                        .distributions = {{"boltzmann_translational",
                                           shares_of(table, "translational"), summary.particles}}};
  if (auto rotational = shares_of(table, "rotational"); !is_zero(rotational)) {
    side.distributions.push_back(
        {"boltzmann_rotational", std::move(rotational), summary.particles});
  }
  return side;
}

}  // namespace clca::compare
