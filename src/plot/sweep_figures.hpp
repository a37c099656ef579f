#pragma once
// Figures of a sweep: a measure against the varied keys.

#include <vector>

#include "clca/plot/plot.hpp"
#include "plot/run_tables.hpp"

namespace clca::plot {

/// One for each stage and measure with a mean in measures.csv, if a key is varied; in the order of
/// the table. Throws StoreError.
std::vector<Figure> sweep_figures(RunTables& tables, const Template& one);

}  // namespace clca::plot
