#pragma once
// The results of runs, the tables of a sweep and its overview, the final pictures side by side.
// They do not depend on the order in which runs ended.

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
#include "clca/sweep/plan.hpp"

namespace clca::sweep {

enum class Status : std::uint8_t { waiting, done, failed, interrupted };

struct Result {
  Status status = Status::waiting;
  store::RunSummary summary;  ///< of a run that is done
  std::string error;          ///< why it failed

  /// All but the summary, which has a form of its own.
  CLCA_FIELDS(status, error);
};

/// The varied values of a combination. Spreadsheets take text that begins with one of =+-@ for a
/// formula; a quote in front keeps it text.
std::vector<store::Cell> value_cells(const std::vector<std::string>& values);

struct NamedTable {
  std::string name;  ///< of the file without its ending
  store::Table table;
};

/// A row for each run of the plan; `results` in the order of the plan.
NamedTable runs_table(const Plan& plan, const std::vector<Result>& results);

/// Statistics over the completed runs for each combination, stage and measure.
NamedTable measures_table(const Plan& plan, const std::vector<Result>& results);

/// mean-series, mean-probes and so on: each column with its mean and its standard error
/// over the completed runs, `results` in the order of the plan. Tables of time begin with each
/// stage and go as far as all runs of a combination do. `folder_of` a run of the plan. What cannot
/// be read is left out, with a line to `warning`.
std::vector<NamedTable> mean_tables(
    const Plan& plan, const std::vector<Result>& results,
    const std::function<std::filesystem::path(std::size_t run)>& folder_of,
    const std::function<void(const std::string& line)>& warning);

/// The runs that the overview shows, row by row.
struct Selection {
  std::vector<std::size_t> runs;
  int columns = 1;
};

/// A row per combination and a column per seed (the first ones). If nothing varies, the seeds fill
/// the rows; with one seed, the combinations.
Selection selection(const Plan& plan);

/// Reads the pictures from the run folders of the sweep in `folder`; missing ones are empty boxes.
/// None if the scenes request no pictures.
std::optional<render::Image> overview(const Plan& plan, const std::vector<Result>& results,
                                      const std::filesystem::path& folder);

}  // namespace clca::sweep
