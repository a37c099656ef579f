#include "clca/measure/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clca::measure {

Eigen::Vector2d in_box(const lattice::Lattice& lattice, const Eigen::Vector2d& point) {
  return {point.x() - lattice.size().x() * lattice.image(point.x()), point.y()};
}

std::vector<Displacement> displacements_in_step(const grains::State& state,
                                                const std::vector<Eigen::Vector2d>& velocities) {
  std::vector<Displacement> result;
  for (std::size_t id = 0; id < velocities.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (particle.present) {
      result.push_back({.from = in_box(state.lattice, grains::centre(state, particle)),
                        .vector = velocities[id],
                        .sites = static_cast<double>(state.shape(particle).size())});
    }
  }
  return result;
}

Snapshot::Snapshot(const grains::State& state)
    : step_(state.step), centres_(state.particles.size()) {
  for (std::size_t id = 0; id < centres_.size(); ++id) {
    if (state.particles[id].present) {
      centres_[id] = grains::centre(state, state.particles[id]);
    }
  }
}

bool Snapshot::precedes(const grains::State& now) const {
  const auto in_reach = [](const std::optional<Eigen::Vector2d>& centre) {
    constexpr double kMaxCoordinate = 1e9;
    return !centre ||
           (std::abs(centre->x()) < kMaxCoordinate && std::abs(centre->y()) < kMaxCoordinate);
  };
  return step_ <= now.step && centres_.size() <= now.particles.size() &&
         std::all_of(centres_.begin(), centres_.end(), in_reach);
}

std::optional<Eigen::Vector2d> Snapshot::start(const grains::State& now, std::size_t id) const {
  if (id < centres_.size()) {
    return centres_[id];
  }
  grains::Particle entered = now.particles[id];
  entered.column = now.origins[id].column;
  entered.row = now.origins[id].row;
  return grains::centre(now, entered);
}

void Snapshot::require_later(const grains::State& now) const {
  if (step_ > now.step || centres_.size() > now.particles.size()) {
    throw std::invalid_argument("a state is not one that followed the snapshot");
  }
}

std::vector<std::optional<Eigen::Vector2d>> Snapshot::velocities(const grains::State& now) const {
  require_later(now);
  std::vector<std::optional<Eigen::Vector2d>> result(now.particles.size());
  if (step_ == now.step) {
    return result;
  }
  const auto steps = static_cast<double>(now.step - step_);
  for (std::size_t id = 0; id < centres_.size(); ++id) {
    if (centres_[id] && now.particles[id].present) {
      result[id] = (grains::centre(now, now.particles[id]) - *centres_[id]) / steps;
    }
  }
  return result;
}

std::vector<Displacement> Snapshot::displacements(const grains::State& now) const {
  require_later(now);
  std::vector<Displacement> result;
  result.reserve(centres_.size());
  for (std::size_t id = 0; id < centres_.size(); ++id) {
    const grains::Particle& particle = now.particles[id];
    if (centres_[id] && particle.present) {
      result.push_back({.from = in_box(now.lattice, *centres_[id]),
                        .vector = grains::centre(now, particle) - *centres_[id],
                        .sites = static_cast<double>(now.shape(particle).size())});
    }
  }
  return result;
}

}  // namespace clca::measure
