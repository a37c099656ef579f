#pragma once
// What is drawn of a run or a sweep.

#include <string>
#include <vector>

#include "clca/plot/plot.hpp"
#include "plot/run_tables.hpp"

namespace clca::plot {

/// Those of a template, one for each of its divisions; none if the tables lack something. Throws
/// StoreError.
std::vector<Figure> template_figures(RunTables& tables, const Template& figure_template);

/// Of a run: one for each chosen column, with a curve for each value of another one. Throws
/// StoreError, and text::InputError for a choice of what is not there.
std::vector<Figure> column_figures(RunTables& tables, const Template& figure_template,
                                   const Choice& choice);

/// KEY=VALUE, KEY=VALUE of some columns.
struct RowLabels {
  std::vector<std::string> all;      ///< each once, in the order of their values
  std::vector<std::size_t> of_rows;  ///< positions in `all`
};

/// Words of a single key that was chosen speak for themselves.
RowLabels labels_of(const store::ReadTable& table, const std::vector<std::size_t>& keys,
                    bool is_chosen);

/// What figures of a sweep set, with a curve for each of the lines. `part`: of the sweep.
struct SweepSetting {
  std::string file;
  std::string part;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> lines;
  bool log_x = false;
  bool log_y = false;
};
std::string to_text(const SweepSetting& setting);

/// One for each stage and measure with a mean other than 0 in measures.csv, if a key is varied; in
/// the order of the table. Throws StoreError, and text::InputError for a choice of what is not
/// there.
std::vector<Figure> sweep_figures(RunTables& tables, const Template& figure_template,
                                  const Choice& choice);

/// One for each group of rows and column of the tables that are averaged over the seeds,
/// `mean-*.csv`, with a curve for each combination. Throws StoreError.
std::vector<Figure> mean_figures(RunTables& tables, const Template& figure_template,
                                 const Choice& choice);

}  // namespace clca::plot
