#include "sweep/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRuns = "runs.csv";
constexpr const char* kMeasures = "measures.csv";
constexpr const char* kOverview = "overview.png";

std::string to_json(const Plan& plan) {
  using Json = nlohmann::ordered_json;
  Json variations = Json::array();
  for (const Variation& variation : plan.request.variations) {
    variations.push_back({{"keys", variation.keys}, {"rows", variation.rows}});
  }
  const Json object = {{"clca", run::version()},        {"scene", plan.request.scene.string()},
                       {"title", plan.title()},         {"set", plan.request.overrides},
                       {"vary", std::move(variations)}, {"seeds", to_text(plan.request.seeds)},
                       {"runs", plan.run_count()}};
  constexpr int kIndent = 2;
  // Names of files need not be UTF-8.
  return object.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

SweepFolder::SweepFolder(const fs::path& path) : files_(path) {
  if (files_.owns(store::kSummaryFile)) {
    throw store::StoreError(fmt::format(
        "cannot sweep in {}: it is the folder of a run; write elsewhere", files_.path().string()));
  }
  for (const char* name : {kRuns, kMeasures, kOverview}) {
    files_.require_free(name);
  }
}

void SweepFolder::begin(const Plan& plan) const {
  files_.write("sweep.json", to_json(plan));
  files_.remove(kOverview);
  files_.make_folder("runs");
}

void SweepFolder::write_tables(const std::string& runs, const std::string& measures) const {
  files_.write(kRuns, runs);
  files_.write(kMeasures, measures);
}

void SweepFolder::write_means(const std::vector<NamedTable>& means) const {
  std::error_code error;
  std::vector<std::string> old;
  for (fs::directory_iterator it(files_.path(), error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with("mean-") && std::ranges::count(means, name, &NamedTable::name) == 0) {
      old.push_back(name);
    }
  }
  std::ranges::for_each(old, [this](const std::string& name) { files_.remove(name); });
  for (const NamedTable& table : means) {
    files_.write(table.name, table.csv);
  }
}

void SweepFolder::write_overview(const std::vector<std::uint8_t>& png) const {
  files_.write(kOverview, png);
}

}  // namespace clca::sweep
