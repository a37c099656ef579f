#include "clca/measure/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lattice/internal/require.hpp"

namespace clca::measure {

namespace {

void check_origins(const grains::State& state) {
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
}

/// Number of particle sites per column; columns are not wrapped at a periodic boundary.
class ColumnCounts {
 public:
  /// `at_origin`: at the start of the stage.
  ColumnCounts(const grains::State& state, bool at_origin) {
    check_origins(state);
    int low = std::numeric_limits<int>::max();
    int high = std::numeric_limits<int>::min();
    for_each_column(state, at_origin, [&](int column) {
      low = std::min(low, column);
      high = std::max(high, column);
      ++sites_;
    });
    if (sites_ > 0) {
      first_ = low;
      counts_.resize(static_cast<std::size_t>(high - low) + 1, 0);
      for_each_column(state, at_origin,
                      [&](int column) { ++counts_[static_cast<std::size_t>(column - low)]; });
    }
  }

  std::size_t sites() const { return sites_; }
  int first() const { return first_; }
  int last() const { return first_ + static_cast<int>(counts_.size()) - 1; }
  /// Column of the site `number`, counted from the left, from 0.
  int column_of(std::size_t number) const {
    std::size_t column = 0;
    while (number >= counts_[column]) {
      number -= counts_[column++];
    }
    return first_ + static_cast<int>(column);
  }

 private:
  template <class Visit>
  static void for_each_column(const grains::State& state, bool at_origin, Visit visit) {
    for (std::size_t id = 0; id < state.particles.size(); ++id) {
      const grains::Particle& particle = state.particles[id];
      const int reference = at_origin ? state.origins[id].column : particle.column;
      if (particle.present) {
        for (const lattice::Axial part : state.shape(particle).sites()) {
          visit(reference + part.x);
        }
      }
    }
  }

  int first_ = 0;
  std::size_t sites_ = 0;
  std::vector<std::size_t> counts_;
};

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
  const ColumnCounts before(state, true);
  const ColumnCounts after(state, false);
  if (after.sites() == 0) {
    return std::nullopt;
  }
  const std::size_t last = after.sites() - 1;
  const auto one_percent = static_cast<std::size_t>(0.01 * static_cast<double>(last));
  const int to_right = after.last() - before.last();
  const int to_left = before.first() - after.first();
  const int front = std::max(to_right, to_left);
  const bool at_side =
      !state.lattice.periodic() && ((to_right > 0 && after.last() == state.lattice.columns() - 1) ||
                                    (to_left > 0 && after.first() == 0));
  const int most = std::max(after.column_of(last - one_percent) - before.last(),
                            before.first() - after.column_of(one_percent));
  return Runout{.front = lattice::kColumnPitch * front,
                .percent_99 = lattice::kColumnPitch * most,
                .at_side = at_side};
}

}  // namespace clca::measure
