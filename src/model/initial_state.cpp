#include "clca/model/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "clca/baxter/baxter_model.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/scene/walls.hpp"

namespace clca::model {

namespace {

constexpr int kDegreesPerOrientation = 60;
constexpr double kMaxFraction = 0x1p53;  // of numerator and denominator

std::vector<grains::Kind> kinds_of(const scene::Species& species, std::uint16_t number) {
  std::vector<grains::Kind> kinds;
  for (const int degrees : species.orientations) {
    grains::Kind kind = {lattice::centred(species.shape.rotated(degrees / kDegreesPerOrientation)),
                         number};
    const bool known = std::ranges::any_of(
        kinds, [&](const grains::Kind& other) { return other.shape.is_congruent(kind.shape); });
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

/// Sets rate and unit to a fraction: the first convergent of the continued fraction that rounding
/// could have made this number, so that p particles come in exactly q steps at the rate p/q, and
/// the sum over any number of steps is right. Fractions of 2^32 keep that as their unit.
void set_rate(grains::Source& source, double rate) {
  const double rounding = 2 * (std::nextafter(rate, kMaxFraction) - rate);
  double p_before = 0;
  double q_before = 1;
  double p = 1;
  double q = 0;
  double rest = rate;
  do {
    const double whole = std::floor(rest);
    p_before = std::exchange(p, whole * p + p_before);
    q_before = std::exchange(q, whole * q + q_before);
    rest = 1 / (rest - whole);
  } while (std::abs(p / q - rate) > rounding && std::max(p, q) < kMaxFraction);
  const double times = std::fmod(0x1p32, q) == 0 ? 0x1p32 / q : 1;
  source.rate = static_cast<std::uint64_t>(times * p);
  source.units_per_particle = static_cast<std::uint64_t>(times * q);
}

grains::Source make_source(const grains::State& state, const scene::Source& source) {
  grains::Source result;
  result.sites = scene::source_sites(state.lattice, source);
  result.weights = kind_weights(state, source.species_weights);
  set_rate(result, source.particles_per_step);
  result.max_emitted = source.max_particles.value_or(std::numeric_limits<std::uint64_t>::max());
  return result;
}

}  // namespace

grains::State initial_state(const scene::Scene& scene) {
  scene::check_walls(scene);
  grains::State state{.lattice = scene::lattice_of(scene.box), .seed = scene.seed};
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
                           .passive_rule = wall.passive_rule});
  }
  for (const scene::Source& source : scene.sources) {
    state.sources.push_back(make_source(state, source));
  }
  for (const scene::Outlet& outlet : scene.outlets) {
    state.outlets.push_back({.region = outlet.region});
  }
  return state;
}

}  // namespace clca::model
