#include "clca/measure/displacement.hpp"

#include <algorithm>
#include <cmath>

namespace clca::measure {

namespace {

/// Columns of all particle sites, ascending; `at_origin`: where they were when the stage began.
std::vector<int> site_columns(const automaton::State& state, bool at_origin) {
  std::vector<int> columns;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const automaton::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const int reference = at_origin ? state.origins[id].column : particle.column;
    for (const lattice::Axial part : state.shape(particle).sites()) {
      columns.push_back(reference + part.x);
    }
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

}  // namespace

std::vector<double> displacements(const automaton::State& state) {
  std::vector<double> result(state.particles.size(), 0.0);
  for (std::size_t id = 0; id < result.size(); ++id) {
    const automaton::Particle& particle = state.particles[id];
    if (particle.present) {
      result[id] = lattice::position(particle.site() - state.origins[id]).norm();
    }
  }
  return result;
}

double moved_share(const automaton::State& state, double distance) {
  const std::size_t present = automaton::present_count(state);
  const std::vector<double> moved = displacements(state);
  const auto far =
      std::count_if(moved.begin(), moved.end(), [&](double value) { return value > distance; });
  return present > 0 ? static_cast<double>(far) / static_cast<double>(present) : 0;
}

double smallest_diameter(const automaton::State& state) {
  double smallest = INFINITY;
  for (const automaton::Kind& kind : state.kinds) {
    smallest = std::min(smallest, kind.shape.diameter());
  }
  return smallest;
}

std::optional<Runout> runout(const automaton::State& state) {
  const std::vector<int> before = site_columns(state, true);
  const std::vector<int> after = site_columns(state, false);
  if (after.empty()) {
    return std::nullopt;
  }
  const std::size_t last = after.size() - 1;
  const auto one_percent = static_cast<std::size_t>(0.01 * static_cast<double>(last));
  const int front = std::max(after.back() - before.back(), before.front() - after.front());
  const int most =
      std::max(after[last - one_percent] - before.back(), before.front() - after[one_percent]);
  return Runout{.front = lattice::kColumnPitch * front, .percent_99 = lattice::kColumnPitch * most};
}

}  // namespace clca::measure
