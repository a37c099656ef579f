#pragma once
// The tables of a sweep. They depend on the plan and on what came of each run, not on the order in
// which the runs ended.

#include <string>
#include <vector>

#include "clca/sweep/plan.hpp"
#include "sweep/result.hpp"

namespace clca::sweep {

/// runs.csv: a row for each run of the plan; `results` in the order of the plan.
std::string runs_table(const Plan& plan, const std::vector<Result>& results);

/// measures.csv: for each combination, stage and measure the statistics over the runs that are
/// done.
std::string measures_table(const Plan& plan, const std::vector<Result>& results);

}  // namespace clca::sweep
