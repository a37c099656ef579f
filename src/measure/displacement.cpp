#include "clca/measure/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "lattice/internal/require.hpp"

namespace clca::measure {

namespace {

void check_origins(const grains::State& state) {
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
}

/// Number of particle sites by column; columns are not wrapped at a periodic boundary.
/// `at_origin`: at the start of the stage.
std::map<int, std::size_t> column_counts(const grains::State& state, bool at_origin) {
  check_origins(state);
  std::map<int, std::size_t> counts;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    const int reference = at_origin ? state.origins[id].column : particle.column;
    if (particle.present) {
      for (const lattice::Axial part : state.shape(particle).sites()) {
        ++counts[reference + part.x];
      }
    }
  }
  return counts;
}

/// Column of the site `number`, counted from 0 in the order of `begin`.
template <class Iterator>
int column_of(std::size_t number, Iterator begin) {
  for (; number >= begin->second; ++begin) {
    number -= begin->second;
  }
  return begin->first;
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
  const std::map<int, std::size_t> before = column_counts(state, true);
  const std::map<int, std::size_t> after = column_counts(state, false);
  if (after.empty()) {
    return std::nullopt;
  }
  std::size_t sites = 0;
  for (const auto& [column, count] : after) {
    sites += count;
  }
  const auto one_percent = static_cast<std::size_t>(0.01 * static_cast<double>(sites - 1));
  const int left = before.begin()->first;
  const int right = before.rbegin()->first;
  const int to_right = after.rbegin()->first - right;
  const int to_left = left - after.begin()->first;
  const bool at_side = !state.lattice.periodic() &&
                       ((to_right > 0 && after.rbegin()->first == state.lattice.columns() - 1) ||
                        (to_left > 0 && after.begin()->first == 0));
  const int most = std::max(column_of(one_percent, after.rbegin()) - right,
                            left - column_of(one_percent, after.begin()));
  return Runout{.front = lattice::kColumnPitch * std::max(to_right, to_left),
                .percent_99 = lattice::kColumnPitch * most,
                .at_side = at_side};
}

}  // namespace clca::measure
