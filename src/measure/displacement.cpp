#include "clca/measure/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "measure/places.hpp"

namespace clca::measure {

namespace {

void check_origins(const grains::State& state) {
  require(state.origins.size() == state.particles.size(), "not every particle has an origin");
}

/// Number of particle sites by column, not wrapped; `at_origin`: at the start of the stage.
std::map<int, std::size_t> column_counts(const grains::State& state, bool at_origin) {
  check_origins(state);
  std::map<int, std::size_t> counts;
  for_each_present(state, [&](std::uint32_t id, const grains::Particle& particle) {
    const int reference = at_origin ? state.origins[id].column : particle.column;
    for (const lattice::Axial part : state.shape(particle).sites()) {
      ++counts[reference + part.x];
    }
  });
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

std::vector<Displacement> displacements_in_step(const grains::State& state,
                                                const std::vector<Eigen::Vector2d>& velocities) {
  require(velocities.size() == state.particles.size(), "not every particle has a velocity");
  std::vector<Displacement> result;
  for_each_present(state, [&](std::uint32_t id, const grains::Particle& particle) {
    result.push_back({.from = grains::centre_in_box(state, particle),
                      .vector = velocities[id],
                      .sites = static_cast<double>(state.shape(particle).size())});
  });
  return result;
}

Snapshot::Snapshot(const grains::State& state) : step_(state.step), sites_(state.particles.size()) {
  for_each_present(state, [&](std::uint32_t id, const grains::Particle& particle) {
    sites_[id] = particle.site();
  });
}

bool Snapshot::precedes(const grains::State& now) const {
  const auto is_small = [](int coordinate) {
    constexpr int kMaxCoordinate = 1'000'000'000;
    return coordinate > -kMaxCoordinate && coordinate < kMaxCoordinate;
  };
  const auto in_reach = [&](const std::optional<lattice::Site>& site) {
    return !site || (is_small(site->column) && is_small(site->row));
  };
  return step_ <= now.step && sites_.size() <= now.particles.size() &&
         std::ranges::all_of(sites_, in_reach);
}

std::optional<Displacement> Snapshot::displacement(const grains::State& now, std::size_t id) const {
  const std::optional<lattice::Site> from = id < sites_.size() ? sites_[id] : now.origins[id];
  if (!from) {
    return std::nullopt;
  }
  const grains::Particle& particle = now.particles[id];
  grains::Particle before = particle;
  before.column = from->column;
  before.row = from->row;
  return Displacement{.from = grains::centre_in_box(now, before),
                      .vector = lattice::position(particle.site() - *from),
                      .sites = static_cast<double>(now.shape(particle).size())};
}

void Snapshot::require_later(const grains::State& now) const {
  require(step_ <= now.step && sites_.size() <= now.particles.size(),
          "a state is not one that followed the snapshot");
}

std::vector<std::optional<Eigen::Vector2d>> Snapshot::velocities(const grains::State& now) const {
  require_later(now);
  std::vector<std::optional<Eigen::Vector2d>> result(now.particles.size());
  if (step_ == now.step) {
    return result;
  }
  const auto steps = static_cast<double>(now.step - step_);
  for (std::size_t id = 0; id < sites_.size(); ++id) {
    if (sites_[id] && now.particles[id].present) {
      result[id] = displacement(now, id)->vector / steps;
    }
  }
  return result;
}

std::vector<Displacement> Snapshot::displacements(const grains::State& now) const {
  require_later(now);
  std::vector<Displacement> result;
  result.reserve(sites_.size());
  for (std::size_t id = 0; id < sites_.size(); ++id) {
    if (sites_[id] && now.particles[id].present) {
      result.push_back(*displacement(now, id));
    }
  }
  return result;
}

std::vector<double> distances_from_origins(const grains::State& state) {
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

double smallest_kind_diameter(const grains::State& state) {
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
                .percentile_99 = lattice::kColumnPitch * most,
                .reaches_side = at_side};
}

}  // namespace clca::measure
