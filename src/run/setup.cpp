#include "clca/run/setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/lattice/shape.hpp"
#include "clca/scene/walls.hpp"

namespace clca::run {

namespace {

constexpr int kDegreesPerTurn = 60;

std::vector<grains::Kind> kinds_of(const scene::Species& species, std::uint16_t number) {
  std::vector<grains::Kind> kinds;
  for (const int degrees : species.orientations) {
    grains::Kind kind = {lattice::centred(species.shape.rotated(degrees / kDegreesPerTurn)),
                         number};
    const bool known = std::any_of(kinds.begin(), kinds.end(), [&](const grains::Kind& other) {
      return other.shape.congruent(kind.shape);
    });
    if (!known) {
      kinds.push_back(std::move(kind));
    }
  }
  return kinds;
}

/// Divides the weight of a species among its kinds, in integers.
std::vector<std::uint32_t> kind_weights(const grains::State& state,
                                        const std::vector<std::uint32_t>& species_weights) {
  constexpr std::uint32_t kCommon = 60;  // divisible by 1 to 6
  std::vector<std::uint32_t> count(species_weights.size(), 0);
  for (const grains::Kind& kind : state.kinds) {
    ++count[kind.species];
  }
  std::vector<std::uint32_t> weights;
  for (const grains::Kind& kind : state.kinds) {
    weights.push_back(species_weights[kind.species] * (kCommon / count[kind.species]));
  }
  return weights;
}

grains::Source make_source(const grains::State& state, const scene::Source& source) {
  grains::Source result;
  if (const auto* point = std::get_if<Eigen::Vector2d>(&source.position)) {
    result.sites = {lattice::nearest_site(*point)};
  } else {
    result.sites = lattice::sites_in(state.lattice, std::get<lattice::Rectangle>(source.position));
  }
  result.weights = kind_weights(state, source.weights);
  result.rate = static_cast<std::uint64_t>(std::llround(source.rate * 0x1p32));
  result.count = source.count.value_or(std::numeric_limits<std::uint64_t>::max());
  return result;
}

}  // namespace

grains::State initial_state(const scene::Scene& scene) {
  scene::check_walls(scene);
  grains::State state{
      .lattice = lattice::Lattice::covering(scene.box.width, scene.box.height, scene.box.periodic),
      .seed = scene.seed};
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto number = static_cast<std::uint16_t>(i);
    const std::vector<grains::Kind> kinds = scene.model == scene::Model::baxter
                                                ? baxter::kinds_along_axes(number)
                                                : kinds_of(scene.species[i], number);
    state.kinds.insert(state.kinds.end(), kinds.begin(), kinds.end());
  }
  const std::vector<bool> there = scene::walls_present_at_start(scene);
  for (std::size_t number = 0; number < scene.walls.size(); ++number) {
    const scene::Wall& wall = scene.walls[number];
    state.walls.push_back({.sites = scene::wall_sites(state.lattice, wall),
                           .present = there[number],
                           .motion = wall.motion,
                           .passive = wall.passive});
  }
  for (const scene::Source& source : scene.sources) {
    state.sources.push_back(make_source(state, source));
  }
  for (const scene::Outlet& outlet : scene.outlets) {
    state.outlets.push_back({.region = outlet.region});
  }
  return state;
}

}  // namespace clca::run
