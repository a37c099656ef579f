#include "clca/measure/snapshot.hpp"

#include <algorithm>

#include "lattice/internal/require.hpp"

namespace clca::measure {

std::vector<Displacement> displacements_in_step(const grains::State& state,
                                                const std::vector<Eigen::Vector2d>& velocities) {
  std::vector<Displacement> result;
  for (std::size_t id = 0; id < velocities.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (particle.present) {
      result.push_back({.from = grains::centre_in_box(state, particle),
                        .vector = velocities[id],
                        .sites = static_cast<double>(state.shape(particle).size())});
    }
  }
  return result;
}

Snapshot::Snapshot(const grains::State& state) : step_(state.step), sites_(state.particles.size()) {
  for (std::size_t id = 0; id < sites_.size(); ++id) {
    if (state.particles[id].present) {
      sites_[id] = state.particles[id].site();
    }
  }
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

std::optional<Displacement> Snapshot::path(const grains::State& now, std::size_t id) const {
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
      result[id] = path(now, id)->vector / steps;
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
      result.push_back(*path(now, id));
    }
  }
  return result;
}

}  // namespace clca::measure
