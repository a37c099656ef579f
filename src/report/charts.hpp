#pragma once
// Which charts the tables of a run allow.

#include <vector>

#include "report/chart.hpp"
#include "report/tables.hpp"

namespace clca::report {

std::vector<Chart> charts_of_automaton(const Tables& tables);
std::vector<Chart> charts_of_gas(const Tables& tables);

/// Rows of a table that belong together: all with the same text in a column, or simply all.
struct Group {
  std::string name;
  std::vector<std::size_t> rows;
};

/// By the values of a column, as they come. One group without a name where there is no such column
/// or it has more values than curves can be told apart.
std::vector<Group> groups_of(const RunTable& table, const std::string& column);

/// Values in the rows of a group.
std::vector<double> of_group(const std::vector<double>& column, const Group& group);

/// The density of a histogram with bins from `lower` to `upper`; a last bin without end is left
/// out, since it has none.
Curve density_curve(const std::string& name, const std::vector<double>& lower,
                    const std::vector<double>& upper, const std::vector<double>& share);

/// Adds a chart that has something to say: a value other than 0.
void add_chart(std::vector<Chart>& charts, Chart chart);

}  // namespace clca::report
