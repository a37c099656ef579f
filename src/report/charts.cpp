#include "report/charts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace clca::report {

std::vector<Group> groups_of(const RunTable& table, const std::string& column) {
  constexpr std::size_t kMostGroups = 64;
  std::vector<Group> groups;
  std::map<std::string, std::size_t> places;
  const std::vector<std::string>* names = table.cells().find(column);
  for (std::size_t row = 0; names != nullptr && row < names->size(); ++row) {
    const auto [place, is_new] = places.emplace((*names)[row], groups.size());
    if (is_new) {
      groups.push_back({.name = (*names)[row], .rows = {}});
    }
    groups[place->second].rows.push_back(row);
  }
  if (names != nullptr && groups.size() <= kMostGroups) {
    return groups;
  }
  Group all;
  for (std::size_t row = 0; row < table.cells().rows(); ++row) {
    all.rows.push_back(row);
  }
  return {all};
}

std::vector<double> of_group(const std::vector<double>& column, const Group& group) {
  std::vector<double> values;
  values.reserve(group.rows.size());
  for (const std::size_t row : group.rows) {
    values.push_back(column[row]);
  }
  return values;
}

Curve density_curve(const std::string& name, const std::vector<double>& lower,
                    const std::vector<double>& upper, const std::vector<double>& share) {
  Curve curve;
  curve.name = name;
  curve.is_steps = true;
  for (std::size_t bin = 0; bin < share.size(); ++bin) {
    if (!std::isfinite(upper[bin]) || !(upper[bin] > lower[bin])) {
      continue;
    }
    curve.x.push_back(lower[bin]);
    curve.y.push_back(share[bin] / (upper[bin] - lower[bin]));
  }
  if (!curve.x.empty()) {  // the last bin ends somewhere, too
    curve.x.push_back(*std::max_element(upper.begin(), upper.end(), [](double a, double b) {
      return (std::isfinite(a) ? a : 0) < (std::isfinite(b) ? b : 0);
    }));
    curve.y.push_back(curve.y.back());
  }
  return curve;
}

void add_chart(std::vector<Chart>& charts, Chart chart) {
  const auto says_something = [](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(),
                       [](double y) { return std::isfinite(y) && y != 0; });
  };
  std::erase_if(chart.curves, [](const Curve& curve) { return curve.x.empty(); });
  if (is_drawable(chart) && std::any_of(chart.curves.begin(), chart.curves.end(), says_something)) {
    charts.push_back(std::move(chart));
  }
}

}  // namespace clca::report
