#pragma once
// The runs of a sweep, new or of an earlier sweep, and what is made of their results: tables, and
// the overview, the final pictures side by side. Tables and overview do not depend on the order in
// which runs ended.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clca/reflection/reflection.hpp"
#include "clca/render/image.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "clca/sweep/sweep.hpp"

namespace clca::sweep {

enum class Status : std::uint8_t { waiting, done, failed, interrupted };

struct RunResult {
  Status status = Status::waiting;
  store::RunSummary summary;  ///< of a run that is done
  std::string error;          ///< why it failed

  CLCA_FIELDS(status, error);  ///< all but the summary, which has a form of its own
};

inline constexpr const char* kRunsFolder = "runs";

inline std::filesystem::path run_folder(const std::filesystem::path& sweep,
                                        const std::string& name) {
  return sweep / kRunsFolder / name;
}

struct EarlierRun {
  store::RunSummary summary;
  /// It is of exactly this scene and program version, and has the pictures that are wanted.
  bool is_reusable = false;
};

/// The run in `folder`, if one was done there.
std::optional<EarlierRun> earlier_run(const std::filesystem::path& folder,
                                      const scene::Scene& scene, run::WantedPictures pictures);

struct RunOutcome {
  RunResult result;
  std::vector<std::string> warnings;
  std::string store_error;  ///< something could not be written; empty: all was
  bool is_in_use = false;   ///< another process is at work on it

  CLCA_FIELDS(result, warnings, store_error, is_in_use);
};

/// Executes a run in its folder, or goes on with it where it was stopped or killed. `progress` may
/// be empty.
RunOutcome execute_run(const scene::Scene& scene, const std::filesystem::path& folder,
                       const Options& options, run::WantedPictures pictures,
                       const std::atomic<int>* stop,
                       std::function<void(const run::Progress&)> progress);

/// Messages between processes.
tasks::Bytes to_bytes(const RunOutcome& run);
RunOutcome run_outcome(const tasks::Bytes& bytes);

/// The varied values of a combination. Spreadsheets take text that begins with one of =+-@ for a
/// formula; a quote in front keeps it text.
std::vector<store::Cell> value_cells(const std::vector<std::string>& values);

struct NamedTable {
  std::string name;  ///< of the file without its ending
  store::Table table;
};

/// A row for each run of the plan; `results` in the order of the plan.
NamedTable runs_table(const Plan& plan, const std::vector<RunResult>& results);

/// Statistics over the completed runs for each combination, stage and measure.
NamedTable measures_table(const Plan& plan, const std::vector<RunResult>& results);

/// mean-series, mean-probes and so on: each column with its mean and its standard error
/// over the completed runs, `results` in the order of the plan. Tables of time begin with each
/// stage and go as far as all runs of a combination do. `folder_of`: folder of a run. What cannot
/// be read is left out, with a line to `warning`.
std::vector<NamedTable> mean_tables(
    const Plan& plan, const std::vector<RunResult>& results,
    const std::function<std::filesystem::path(std::size_t run)>& folder_of,
    const std::function<void(const std::string& line)>& warning);

struct OverviewRuns {
  std::vector<std::size_t> runs;
  int columns = 1;
};

/// A row per combination and a column per seed (the first ones). If nothing varies, the seeds fill
/// the rows; with one seed, the combinations.
OverviewRuns overview_runs(const Plan& plan);

/// Reads the pictures from the run folders of the sweep in `folder`; missing ones are empty boxes.
/// None if the scenes request no pictures.
std::optional<render::Image> overview_image(const Plan& plan, const std::vector<RunResult>& results,
                                            const std::filesystem::path& folder);

}  // namespace clca::sweep
