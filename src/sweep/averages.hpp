#pragma once
// Tables of the runs averaged over the seeds, for each combination.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "clca/sweep/plan.hpp"
#include "sweep/result.hpp"

namespace clca::sweep {

struct NamedTable {
  std::string name;  ///< of the file
  std::string csv;
};

/// mean-series.csv, mean-probes.csv and so on: each column with its mean and its standard error
/// over the completed runs, `results` in the order of the plan. Tables of time begin with each
/// stage and go as far as all runs of a combination do. `folder_of` a run of the plan. What cannot
/// be read is left out, with a line to `warning`.
std::vector<NamedTable> mean_tables(
    const Plan& plan, const std::vector<Result>& results,
    const std::function<std::filesystem::path(std::size_t run)>& folder_of,
    const std::function<void(const std::string& line)>& warning);

}  // namespace clca::sweep
