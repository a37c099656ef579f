// Maps of fields.csv and convection-STAGE.csv.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/charts.hpp"
#include "report/map.hpp"
#include "report/maps.hpp"
#include "report/measure_names.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMostStagesOfMaps = 6;

/// Columns of fields.csv.
struct FieldColumns {
  std::vector<double> step;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> packing;
  std::vector<double> particles;
  std::vector<double> vx;
  std::vector<double> vy;
  std::vector<double> fluctuation;
};

std::optional<FieldColumns> field_columns(const RunTable& table) {
  FieldColumns columns;
  for (const auto& [name, column] :
       {std::pair("step", &columns.step), std::pair("x", &columns.x), std::pair("y", &columns.y),
        std::pair("packing", &columns.packing), std::pair("particles", &columns.particles),
        std::pair("vx", &columns.vx), std::pair("vy", &columns.vy),
        std::pair("fluctuation", &columns.fluctuation)}) {
    auto numbers = table.numbers(name);
    if (!numbers) {
      return std::nullopt;
    }
    *column = std::move(*numbers);
  }
  return columns;
}

/// What a cell has over the windows of a stage.
struct CellSum {
  double packing = 0;
  double particles = 0;
  double vx = 0;
  double vy = 0;
  double fluctuation = 0;
};

std::map<std::pair<double, double>, CellSum> cell_sums(const FieldColumns& all,
                                                       const Group& stage) {
  std::map<std::pair<double, double>, CellSum> sums;
  const auto or_zero = [](double value) { return std::isfinite(value) ? value : 0; };
  for (const std::size_t row : stage.rows) {
    if (!std::isfinite(all.x[row]) || !std::isfinite(all.y[row])) {
      continue;
    }
    CellSum& sum = sums[{all.x[row], all.y[row]}];
    const double particles = or_zero(all.particles[row]);
    sum.packing += or_zero(all.packing[row]);
    sum.particles += particles;
    sum.vx += particles * or_zero(all.vx[row]);
    sum.vy += particles * or_zero(all.vy[row]);
    sum.fluctuation += particles * or_zero(all.fluctuation[row]);
  }
  return sums;
}

std::size_t windows(const FieldColumns& all, const Group& stage) {
  std::set<double> steps;
  for (const std::size_t row : stage.rows) {
    steps.insert(all.step[row]);
  }
  return steps.size();
}

/// Packing with velocities over it, and the energy of the fluctuations; means over the stage, of
/// the velocities by particle.
void add_maps_of_stage(std::vector<std::string>& figures, const FieldColumns& all,
                       const Group& stage, const std::optional<scene::Conversion>& units) {
  const std::size_t count = windows(all, stage);
  const std::string when = fmt::format(" in stage {}, mean over {} {}", stage.name, count,
                                       count == 1 ? "window" : "windows");
  Map packing = {.title = "Packing and velocity" + when,
                 .value_title = "packing",
                 .arrow_title = shown_unit("spacings/step", units)};
  Map energy = {.title = "Energy of fluctuations" + when,
                .value_title = shown_unit("½⟨|v - ⟨v⟩|²⟩, (spacings/step)²", units)};
  for (const auto& [place, sum] : cell_sums(all, stage)) {
    const double weight = std::max(sum.particles, 1.0);
    packing.cells.push_back({.x = place.first,
                             .y = place.second,
                             .value = sum.packing / static_cast<double>(count),
                             .dx = sum.vx / weight,
                             .dy = sum.vy / weight});
    energy.cells.push_back(
        {.x = place.first, .y = place.second, .value = sum.fluctuation / weight});
  }
  for (Map* map : {&packing, &energy}) {
    set_cell_size(*map);
    figures.push_back(to_html(coarsened(std::move(*map))));
  }
}

}  // namespace

void add_field_maps(std::vector<std::string>& figures, const Tables& tables) {
  const auto table = tables.find("fields");
  const auto columns = table ? field_columns(*table) : std::nullopt;
  if (!columns) {
    return;
  }
  const std::vector<Group> stages = groups_of(*table, "stage");
  for (const std::size_t stage : evenly(stages.size(), kMostStagesOfMaps)) {
    add_maps_of_stage(figures, *columns, stages[stage], tables.summary().units);
  }
}

void add_convection_maps(std::vector<std::string>& figures, const Tables& tables) {
  for (const RunTable& table : tables.find_all("convection")) {
    const auto x = table.numbers("x");
    const auto y = table.numbers("y");
    const auto dx = table.numbers("dx");
    const auto dy = table.numbers("dy");
    if (!x || !y || !dx || !dy) {
      continue;
    }
    Map map = {.title = "Mean drift per cycle in stage " + table.label(),
               .arrow_title = "spacings per cycle"};
    for (std::size_t row = 0; row < x->size(); ++row) {
      map.cells.push_back({(*x)[row], (*y)[row], 0, (*dx)[row], (*dy)[row]});
    }
    set_cell_size(map);
    figures.push_back(to_html(coarsened(std::move(map))));
  }
}

}  // namespace clca::report
