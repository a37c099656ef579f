#pragma once
// Figures of a sweep: a measure against the varied keys.

#include <vector>

#include "clca/plot/plot.hpp"
#include "plot/run_tables.hpp"

namespace clca::plot {

/// One for each stage and measure with a mean other than 0 in measures.csv, if a key is varied; in
/// the order of the table. Throws StoreError, and text::InputError for a choice of what is not
/// there.
std::vector<Figure> sweep_figures(RunTables& tables, const Template& one, const Choice& choice);

}  // namespace clca::plot
