#include "clca/measure/displacement.hpp"

#include <algorithm>
#include <cmath>

#include "lattice/internal/require.hpp"

namespace clca::measure {

namespace {

void check_origins(const grains::State& state) {
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
}

/// Columns of all particle sites, ascending; they are not wrapped at a periodic boundary.
/// `at_origin`: at the start of the stage.
std::vector<int> site_columns(const grains::State& state, bool at_origin) {
  check_origins(state);
  std::vector<int> columns;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    const int reference = at_origin ? state.origins[id].column : particle.column;
    if (particle.present) {
      for (const lattice::Axial part : state.shape(particle).sites()) {
        columns.push_back(reference + part.x);
      }
    }
  }
  std::ranges::sort(columns);
  return columns;
}

/// The root of a whole number, so that equal distances in all directions are equal.
double displacement(const grains::State& state, std::size_t id) {
  const grains::Particle& particle = state.particles[id];
  const lattice::Axial way = particle.site() - state.origins[id];
  const double x = way.x;
  const double q = way.q;
  return particle.present ? std::sqrt(x * x + x * q + q * q) : 0;
}

}  // namespace

std::vector<double> displacements(const grains::State& state) {
  check_origins(state);
  std::vector<double> result(state.particles.size(), 0.0);
  for (std::size_t id = 0; id < result.size(); ++id) {
    result[id] = displacement(state, id);
  }
  return result;
}

std::optional<double> moved_share(const grains::State& state, double distance) {
  check_origins(state);
  require(!std::isnan(distance), "a distance must be a number");
  std::size_t far = 0;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    far += displacement(state, id) > distance ? 1U : 0U;
  }
  const std::size_t present = grains::present_count(state);
  if (present == 0) {
    return std::nullopt;
  }
  return static_cast<double>(far) / static_cast<double>(present);
}

double smallest_diameter(const grains::State& state) {
  double smallest = INFINITY;
  for (const grains::Kind& kind : state.kinds) {
    smallest = std::min(smallest, kind.shape.diameter());
  }
  return smallest;
}

std::optional<Runout> runout(const grains::State& state) {
  const std::vector<int> before = site_columns(state, true);
  const std::vector<int> after = site_columns(state, false);
  if (after.empty()) {
    return std::nullopt;
  }
  const std::size_t last = after.size() - 1;
  const auto one_percent = static_cast<std::size_t>(0.01 * static_cast<double>(last));
  const int to_right = after.back() - before.back();
  const int to_left = before.front() - after.front();
  const bool at_side =
      !state.lattice.periodic() && ((to_right > 0 && after.back() == state.lattice.columns() - 1) ||
                                    (to_left > 0 && after.front() == 0));
  const int most =
      std::max(after[last - one_percent] - before.back(), before.front() - after[one_percent]);
  return Runout{.front = lattice::kColumnPitch * std::max(to_right, to_left),
                .percent_99 = lattice::kColumnPitch * most,
                .at_side = at_side};
}

}  // namespace clca::measure
