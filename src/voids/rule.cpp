#include "voids/rule.hpp"

#include <numeric>
#include <stdexcept>

#include "clca/random/draw.hpp"

namespace clca::voids {

namespace {

std::uint64_t weight(double straight, double sieve) {
  if (!(straight >= 0 && straight <= 1 && sieve >= 0 && sieve <= 1)) {
    throw std::invalid_argument("a weight of the void model lies in [0, 1]");
  }
  constexpr double kOne = 0x1p40;
  return static_cast<std::uint64_t>(straight * sieve * kOne);
}

}  // namespace

Rule::Rule(const grains::Box& box, const Rules& rules) : box_(box) {
  for (const grains::Kind& kind : box.state.kinds) {
    if (!rules.sieve.empty() && kind.species >= rules.sieve.size()) {
      throw std::invalid_argument("a species has no weight");
    }
    const double sieve = rules.sieve.empty() ? 1 : rules.sieve[kind.species];
    const std::uint64_t beside = weight((1 - rules.straight) / 2, sieve);
    weights_.push_back({weight(rules.straight, sieve), beside, beside});
  }
}

grains::Owner Rule::claimed(lattice::Site site) const {
  const grains::State& state = box_.state;
  std::array<grains::Owner, kDownward.size()> above{};
  std::array<std::uint64_t, kDownward.size()> weights{};
  for (std::size_t i = 0; i < kDownward.size(); ++i) {
    above[i] = box_.occupancy.owner(state.lattice.index(site + unit(opposite(kDownward[i]))));
    if (grains::is_particle(above[i])) {
      weights[i] = weights_[state.particles[grains::particle_id(above[i])].kind][i];
    }
  }
  const std::uint64_t sum = std::accumulate(weights.begin(), weights.end(), std::uint64_t{0});
  if (sum == 0) {
    return grains::kFree;
  }
  std::size_t chosen = 0;
  const auto item = static_cast<std::uint32_t>(state.lattice.index(site));
  std::uint64_t rest =
      random::below(random::draw(state.seed, state.step, item, random::Purpose::void_choice), sum);
  while (rest >= weights[chosen]) {
    rest -= weights[chosen++];
  }
  return above[chosen];
}

grains::Move Rule::granted(std::uint32_t id, const std::array<bool, 3>& claims) const {
  std::size_t chosen = claims[0] ? 0 : claims[1] ? 1 : 2;
  if (!claims[chosen]) {
    return grains::kRest;
  }
  if (chosen == 1 && claims[2]) {
    const grains::State& state = box_.state;
    chosen += random::draw(state.seed, state.step, id, random::Purpose::void_coin) & 1U;
  }
  return static_cast<grains::Move>(kDownward[chosen]);
}

}  // namespace clca::voids
