#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "report/charts.hpp"

namespace clca::report {

namespace {

constexpr const char* kTime = "time, 1 / (π N (2a)² v₀)";

struct GasQuantity {
  const char* column = "";
  const char* title = "";
  bool cools = false;        ///< over decades, unless the gas is sheared
  bool is_distance = false;  ///< over decades, always
};

std::string gas_name(const Group& group) {
  return group.name.empty() ? "simulation" : "ε = " + group.name;
}

/// The same quantity as the closed form has it, in the colours of the curves.
void add_closed_form(Chart& chart, const RunTable& closure, const std::vector<Group>& gases,
                     const std::string& column) {
  const auto time = closure.numbers("time");
  const auto values = closure.numbers(column);
  if (!time || !values) {
    return;
  }
  bool is_named = false;
  for (const Group& group : groups_of(closure, "restitution")) {
    const auto gas = std::find_if(gases.begin(), gases.end(),
                                  [&](const Group& one) { return one.name == group.name; });
    if (gas != gases.end()) {
      Curve curve;
      curve.name = is_named ? "" : "closed form";
      is_named = true;
      curve.x = of_group(*time, group);
      curve.y = of_group(*values, group);
      curve.is_reference = true;
      curve.color = static_cast<int>(gas - gases.begin());
      chart.curves.push_back(std::move(curve));
    }
  }
}

Chart gas_chart(const RunTable& series, const RunTable* closure, const GasQuantity& quantity) {
  Chart chart = {.title = quantity.title, .x_title = kTime, .curves = {}};
  const std::string column = quantity.column;
  const auto time = series.numbers("time");
  const auto values = series.numbers(column);
  const auto errors = series.numbers(column + "_se");
  if (!time || !values) {
    return chart;
  }
  const bool is_sheared = series.cells().find("p_xy") != nullptr;
  chart.is_logarithmic = quantity.is_distance || (quantity.cools && !is_sheared);
  const auto gases = groups_of(series, "restitution");
  for (const Group& gas : gases) {
    Curve curve;
    curve.name = gas_name(gas);
    curve.x = of_group(*time, gas);
    curve.y = of_group(*values, gas);
    if (errors) {
      curve.spread = of_group(*errors, gas);
    }
    chart.curves.push_back(std::move(curve));
  }
  if (closure != nullptr) {
    add_closed_form(chart, *closure, gases, column);
  }
  return chart;
}

/// What chance alone gives, over all times of the chart.
void add_floor(Chart& chart, const store::RunSummary& summary) {
  if (summary.stages.empty() || chart.curves.empty()) {
    return;
  }
  for (const auto& [name, value] : summary.stages.back().measures) {
    const auto* floor = std::get_if<double>(&value);
    if (name == "hellinger_floor" && floor != nullptr && *floor > 0) {
      const std::vector<double> times = chart.curves.front().x;
      Curve curve;
      curve.name = "chance alone";
      curve.x = {times.front(), times.back()};
      curve.y = {*floor, *floor};
      curve.is_reference = true;
      chart.curves.push_back(std::move(curve));
    }
  }
}

void add_gas_series(std::vector<Chart>& charts, const Tables& tables) {
  constexpr std::array<GasQuantity, 12> kQuantities = {
      GasQuantity{"t_tr", "Translational temperature, relative to time 0", true},
      GasQuantity{"t_rot", "Rotational temperature, relative to time 0", true},
      GasQuantity{"collisions", "Collisions per particle"},
      GasQuantity{"dh_tr", "Distance of translational energy from chi-square (Hellinger)", false,
                  true},
      GasQuantity{"dh_rot", "Distance of rotational energy from chi-square (Hellinger)", false,
                  true},
      GasQuantity{"a2_tr", "Second cumulant of the velocities"},
      GasQuantity{"a2_rot", "Second cumulant of the spins"},
      GasQuantity{"correlation", "Correlation of translational and rotational energy"},
      GasQuantity{"alignment", "Alignment of spins and velocities"},
      GasQuantity{"p_xx", "Pressure p_xx over the mean pressure"},
      GasQuantity{"p_yy", "Pressure p_yy over the mean pressure"},
      GasQuantity{"p_xy", "Shear stress p_xy over the mean pressure"}};
  const auto series = tables.find("series");
  if (!series) {
    return;
  }
  const auto closure = tables.find("closure");
  for (const GasQuantity& quantity : kQuantities) {
    Chart chart = gas_chart(*series, closure ? &*closure : nullptr, quantity);
    if (quantity.is_distance) {
      add_floor(chart, tables.summary());
    }
    add_chart(charts, std::move(chart));
  }
}

/// Rows of a histogram of one energy and restitution.
Group histogram_rows(const RunTable& table, const std::string& energy, const Group& gas) {
  Group rows;
  const std::vector<std::string>* energies = table.cells().find("energy");
  for (const std::size_t row : gas.rows) {
    if (energies != nullptr && (*energies)[row] == energy) {
      rows.rows.push_back(row);
    }
  }
  return rows;
}

/// Curves of the density at one time, and of the reference.
std::vector<Curve> histogram_curves(const RunTable& table, const std::string& energy,
                                    const std::string& restitution) {
  const auto lower = table.numbers("lower");
  const auto upper = table.numbers("upper");
  const auto share = table.numbers("share");
  const auto reference = table.numbers("reference");
  if (!lower || !upper || !share || !reference) {
    return {};
  }
  for (const Group& gas : groups_of(table, "restitution")) {
    if (gas.name == restitution) {
      const Group rows = histogram_rows(table, energy, gas);
      const auto curve = [&](const std::string& name, const std::vector<double>& column) {
        return density_curve(name, of_group(*lower, rows), of_group(*upper, rows),
                             of_group(column, rows));
      };
      std::vector<Curve> curves = {curve("time " + table.label(), *share),
                                   curve("chi-square, 3 degrees of freedom", *reference)};
      curves.back().is_reference = true;
      return curves;
    }
  }
  return {};
}

void add_histograms(std::vector<Chart>& charts, const std::vector<RunTable>& tables) {
  std::vector<std::string> restitutions;
  for (const RunTable& table : tables) {
    for (const Group& gas : groups_of(table, "restitution")) {
      if (std::find(restitutions.begin(), restitutions.end(), gas.name) == restitutions.end()) {
        restitutions.push_back(gas.name);
      }
    }
  }
  for (const std::string& restitution : restitutions) {
    for (const std::string energy : {"translational", "rotational"}) {
      Chart chart = {.title = "Density of the " + energy + " energy X" +
                              (restitution.empty() ? "" : ", ε = " + restitution),
                     .x_title = energy == "rotational" ? "X = |ω|² / ω₀²(t)" : "X = |v|² / v₀²(t)",
                     .curves = {},
                     .is_logarithmic = true};
      std::vector<Curve> references;
      for (const RunTable& table : tables) {
        for (Curve& curve : histogram_curves(table, energy, restitution)) {
          (curve.is_reference ? references : chart.curves).push_back(std::move(curve));
        }
      }
      if (!references.empty()) {  // the same in all
        chart.curves.push_back(std::move(references.front()));
      }
      add_chart(charts, std::move(chart));
    }
  }
}

}  // namespace

std::vector<Chart> charts_of_gas(const Tables& tables) {
  std::vector<Chart> charts;
  add_gas_series(charts, tables);
  add_histograms(charts, tables.find_all("histogram"));
  return charts;
}

}  // namespace clca::report
