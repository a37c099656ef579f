#include "sweep/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clca/record/provenance.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;

constexpr const char* kOverview = "overview.png";

std::string to_json(const Plan& plan, const std::vector<store::TableSummary>& tables,
                    const std::vector<store::ColumnSummary>& measures) {
  using Json = nlohmann::ordered_json;
  Json variations = Json::array();
  for (const Variation& variation : plan.request.variations) {
    variations.push_back({{"keys", variation.keys}, {"rows", variation.rows}});
  }
  const Json object = {{"clca", record::version()},
                       {"scene", plan.request.scene.string()},
                       {"title", plan.title()},
                       {"set", plan.request.overrides},
                       {"vary", std::move(variations)},
                       {"seeds", to_text(plan.request.seeds)},
                       {"runs", plan.run_count()},
                       {"measures", store::to_list(measures)},
                       {"tables", store::to_object(tables)}};
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
  files_.require_own(kRunsFolder);  // of parts of it, brought together from other machines
}

void SweepFolder::begin(const Plan& plan) const {
  write_request(plan, {}, {});
  files_.remove(kOverview);
  files_.make_folder(kRunsFolder);
}

void SweepFolder::write_request(const Plan& plan, const std::vector<store::TableSummary>& tables,
                                const std::vector<store::ColumnSummary>& measures) const {
  files_.write("sweep.json", to_json(plan, tables, measures));
}

void SweepFolder::write_tables(const std::vector<NamedTable>& tables) const {
  for (const NamedTable& table : tables) {
    files_.write(store::table_name(table.name), table.table.to_csv());
  }
}

void SweepFolder::write_means(const std::vector<NamedTable>& means) const {
  for (const std::string& name : files_.files()) {
    const bool is_new = std::ranges::any_of(
        means, [&name](const NamedTable& table) { return store::table_name(table.name) == name; });
    if (name.starts_with("mean-") && !is_new) {
      files_.remove(name);
    }
  }
  write_tables(means);
}

void SweepFolder::write_overview(const std::vector<std::uint8_t>& png) const {
  files_.write(kOverview, png);
}

}  // namespace clca::sweep
