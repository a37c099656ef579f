#include "clca/measure/mixing.hpp"

#include <algorithm>
#include <cmath>

#include "lattice/internal/require.hpp"

namespace clca::measure {

namespace {

/// Length of a vector in the box, by the nearest image where that is periodic.
double distance(const lattice::Lattice& lattice, Eigen::Vector2d between) {
  if (lattice.periodic()) {
    const double width = lattice.size().x();
    between.x() -= width * std::round(between.x() / width);
  }
  return between.norm();
}

double mean_diameter(const grains::State& state, const std::vector<std::uint32_t>& ids) {
  double sum = 0;
  for (const std::uint32_t id : ids) {
    sum += state.shape(state.particles[id]).diameter();
  }
  return ids.empty() ? 0 : sum / static_cast<double>(ids.size());
}

}  // namespace

Mixing::Mixing(const grains::State& state) : begin_(state) {
  std::vector<Eigen::Vector2d> centres;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    centres.push_back(grains::centre_in_box(state, state.particles[id]));
    if (state.particles[id].present) {
      ids.push_back(id);
    }
  }
  diameter_ = mean_diameter(state, ids);
  // By height, so that neighbours are not far apart in the order.
  std::ranges::stable_sort(ids, {}, [&](std::uint32_t id) { return centres[id].y(); });
  const double near = kNear * diameter_;
  for (auto one = ids.begin(); one != ids.end(); ++one) {
    for (auto other = one + 1;
         other != ids.end() && centres[*other].y() - centres[*one].y() <= near; ++other) {
      if (distance(state.lattice, centres[*other] - centres[*one]) <= near) {
        pairs_.push_back({.first = *one, .second = *other});
      }
    }
  }
}

void Mixing::add(const grains::State& now) {
  require(precedes(now), "pairs of another run");
  std::vector<std::optional<Displacement>> paths(now.particles.size());
  for (std::size_t id = 0; id < paths.size(); ++id) {
    if (now.particles[id].present) {
      paths[id] = begin_.path(now, id);
    }
  }
  for (NeighbourPair& pair : pairs_) {
    const auto& first = paths[pair.first];
    const auto& second = paths[pair.second];
    if (!first || !second) {
      continue;
    }
    const double fallen = -0.5 * (first->vector + second->vector).y();
    if (fallen < (pair.passed + 1) * diameter_) {
      continue;
    }
    if (pair.passed == fallen_.size()) {
      fallen_.emplace_back();
    }
    FallenPairs& sums = fallen_[pair.passed++];
    const Eigen::Vector2d parted = second->vector - first->vector;
    const Eigen::Vector2d between = second->from - first->from + parted;
    ++sums.pairs;
    sums.kept += distance(now.lattice, between) <= kStillNear * diameter_ ? 1U : 0U;
    sums.fallen += fallen;
    sums.spread += parted.x() * parted.x();
  }
}

bool Mixing::precedes(const grains::State& now) const {
  return begin_.precedes(now) && (pairs_.empty() || diameter_ > 0) &&
         std::ranges::all_of(pairs_, [&](const NeighbourPair& pair) {
           return pair.first < now.particles.size() && pair.second < now.particles.size() &&
                  pair.passed <= fallen_.size();
         });
}

}  // namespace clca::measure
