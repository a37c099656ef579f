#pragma once
// The tables of a sweep. They do not depend on the order in which runs ended.

#include <string>
#include <vector>

#include "clca/store/table.hpp"
#include "clca/sweep/plan.hpp"
#include "sweep/result.hpp"

namespace clca::sweep {

/// The varied values of a combination. Spreadsheets take text that begins with one of =+-@ for a
/// formula; a quote in front keeps it text.
std::vector<store::Cell> value_cells(const std::vector<std::string>& values);

/// runs.csv: a row for each run of the plan; `results` in the order of the plan.
std::string runs_table(const Plan& plan, const std::vector<Result>& results);

/// measures.csv: statistics over the completed runs for each combination, stage and measure.
std::string measures_table(const Plan& plan, const std::vector<Result>& results);

}  // namespace clca::sweep
