#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "report/charts.hpp"

namespace clca::report {

namespace {

struct Quantity {
  const char* column = "";
  const char* title = "";
  bool is_dots = false;
};

/// Values of a column over those of another, a curve for each stage.
Chart chart_by_stage(const RunTable& table, const char* across, const std::string& x_title,
                     const Quantity& quantity) {
  Chart chart = {.title = quantity.title, .x_title = x_title, .curves = {}};
  const auto x = table.numbers(across);
  const auto y = table.numbers(quantity.column);
  if (x && y) {
    for (const Group& group : groups_of(table, "stage")) {
      Curve curve;
      curve.name = group.name.empty() ? "all stages" : group.name;
      curve.x = of_group(*x, group);
      curve.y = of_group(*y, group);
      curve.is_dots = quantity.is_dots;
      chart.curves.push_back(std::move(curve));
    }
  }
  chart.begins_at_zero = true;
  return chart;
}

/// The axis of the course of a run.
struct Clock {
  const char* column = "step";
  std::string title = "step";
};

Clock clock_of(const RunTable& table, const store::RunSummary& summary) {
  const bool has_time = summary.units && table.cells().find("time") != nullptr;
  return has_time ? Clock{.column = "time", .title = "time, " + summary.units->time_unit} : Clock();
}

/// One curve for each column whose name begins so: travel.plate is that of the wall plate.
Chart chart_by_wall(const RunTable& table, const Clock& clock, const std::string& start,
                    const char* title) {
  Chart chart = {.title = title, .x_title = clock.title, .curves = {}};
  const auto step = table.numbers(clock.column);
  for (const std::string& name : table.cells().names) {
    if (!step || !name.starts_with(start)) {
      continue;
    }
    if (const auto values = table.numbers(name)) {
      Curve curve;
      curve.name = name.substr(start.size());
      curve.x = *step;
      curve.y = *values;
      chart.curves.push_back(std::move(curve));
    }
  }
  return chart;
}

bool changes(const Chart& chart) {
  const double first = chart.curves.empty() ? 0 : chart.curves.front().y.front();
  return std::any_of(chart.curves.begin(), chart.curves.end(), [&](const Curve& curve) {
    return std::any_of(curve.y.begin(), curve.y.end(), [&](double y) { return y != first; });
  });
}

void add_series(std::vector<Chart>& charts, const RunTable& table, const Clock& clock) {
  constexpr std::array<Quantity, 4> kQuantities = {
      Quantity{"moving_share", "Share of the particles that move"},
      Quantity{"mean_height", "Mean height of all particles, lattice spacings"},
      Quantity{"kinetic_energy", "Kinetic energy, weights of a site times lattice spacings"},
      Quantity{"discharged_sites", "Discharged through outlets, sites"}};
  for (const Quantity& quantity : kQuantities) {
    add_chart(charts, chart_by_stage(table, clock.column, clock.title, quantity));
  }
  Chart particles =
      chart_by_stage(table, clock.column, clock.title, {"particles", "Particles in the box"});
  if (changes(particles)) {
    add_chart(charts, std::move(particles));
  }
  add_chart(charts, chart_by_wall(table, clock, "travel.", "Travel of walls from home, sites"));
  add_chart(charts, chart_by_wall(table, clock, "index.", "Overlap that began at a wall, sites"));
}

void add_cycles(std::vector<Chart>& charts, const RunTable& table) {
  constexpr std::array<Quantity, 5> kQuantities = {
      Quantity{"segregation_index", "Segregation index: 0 mixed, 1 all large above all small"},
      Quantity{"lacey_index", "Lacey’s index of mixing: 0 separated, 1 random"},
      Quantity{"intruder_height_rel", "Height of the intruder: 0 on the floor, 1 at the top"},
      Quantity{"repose_angle_deg", "Slope of the surface, degrees", true},
      Quantity{"height_mean", "Mean height of the surface, lattice spacings"}};
  for (const Quantity& quantity : kQuantities) {
    add_chart(charts, chart_by_stage(table, "cycle", "cycle", quantity));
  }
}

void add_profiles(std::vector<Chart>& charts, const std::vector<RunTable>& tables) {
  Chart chart = {.title = "Surface at the end of each stage, lattice spacings",
                 .x_title = "x, lattice spacings",
                 .curves = {},
                 .has_equal_scales = true,
                 .begins_at_zero = true};
  for (const RunTable& table : tables) {
    const auto x = table.numbers("x");
    const auto height = table.numbers("height_end");
    if (x && height) {
      Curve curve;
      curve.name = table.label();
      curve.x = *x;
      curve.y = *height;
      chart.curves.push_back(std::move(curve));
    }
  }
  add_chart(charts, std::move(chart));
}

/// Middles of the bins in units of the mean force, in which the density integrates to 1.
std::vector<double> relative_middles(const std::vector<double>& low,
                                     const std::vector<double>& high,
                                     const std::vector<double>& count) {
  std::vector<double> middles(low.size());
  double sum = 0;
  for (std::size_t bin = 0; bin < low.size(); ++bin) {
    middles[bin] = (low[bin] + high[bin]) / 2;
    sum += middles[bin] * count[bin];
  }
  const double mean = sum / std::accumulate(count.begin(), count.end(), 0.0);
  for (double& middle : middles) {
    middle /= mean;
  }
  return middles;
}

void add_forces(std::vector<Chart>& charts, const std::vector<RunTable>& tables) {
  Chart chart = {.title = "Distribution of the index of force f over the contacts",
                 .x_title = "f / mean f",
                 .curves = {},
                 .is_logarithmic = true};
  for (const RunTable& table : tables) {
    const auto low = table.numbers("low");
    const auto high = table.numbers("high");
    const auto count = table.numbers("count");
    const auto density = table.numbers("density");
    if (low && high && count && density) {
      Curve curve;
      curve.name = table.label();
      curve.x = relative_middles(*low, *high, *count);
      curve.y = *density;
      chart.curves.push_back(std::move(curve));
    }
  }
  add_chart(charts, std::move(chart));
}

void add_fluctuations(std::vector<Chart>& charts, const RunTable& table) {
  Chart chart = {.title = "Energy X of the fluctuations in stage " + table.label() + ", density",
                 .x_title = "X",
                 .curves = {},
                 .is_logarithmic = true};
  const auto lower = table.numbers("lower");
  const auto upper = table.numbers("upper");
  constexpr std::array<Quantity, 3> kColumns = {
      Quantity{"share", "over the mean of the window"},
      Quantity{"share_local", "over the mean of the cell"},
      Quantity{"reference", "chi-square, 2 degrees of freedom"}};
  for (const Quantity& column : kColumns) {
    const auto share = table.numbers(column.column);
    if (lower && upper && share) {
      chart.curves.push_back(density_curve(column.title, *lower, *upper, *share));
      chart.curves.back().is_reference = column.column == kColumns.back().column;
    }
  }
  add_chart(charts, std::move(chart));
}

}  // namespace

std::vector<Chart> charts_of_automaton(const Tables& tables) {
  std::vector<Chart> charts;
  add_profiles(charts, tables.find_all("profile"));
  if (const auto series = tables.find("series")) {
    add_series(charts, *series, clock_of(*series, tables.summary()));
  }
  if (const auto cycles = tables.find("cycles")) {
    add_cycles(charts, *cycles);
  }
  add_forces(charts, tables.find_all("forces"));
  for (const RunTable& table : tables.find_all("fluctuation")) {
    add_fluctuations(charts, table);
  }
  return charts;
}

}  // namespace clca::report
