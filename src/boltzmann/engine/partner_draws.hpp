#pragma once
// Random numbers of a particle in a step of the scheme of Ogawa & Kato: independent, or a point of
// a lattice rule.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "boltzmann/elementary.hpp"
#include "boltzmann/lattice_rule.hpp"
#include "clca/random/words.hpp"

namespace clca::boltzmann {

/// Index of a particle, or its rank if they are sorted.
using ParticleIndex = std::uint32_t;

class IndependentDraws {
 public:
  IndependentDraws(std::uint64_t seed, std::uint64_t step, std::uint64_t particles)
      : seed_(seed), step_(static_cast<std::uint32_t>(step)), others_(particles - 1) {}

  /// Partners other than `particle`, with replacement.
  void partners(ParticleIndex particle, std::span<ParticleIndex> result) const {
    random::Words words{};
    for (std::uint32_t k = 0; k < result.size(); ++k) {
      if (k % words.size() == 0) {
        words =
            random::words(seed_, counter(particle, static_cast<std::uint32_t>(k / words.size())),
                          random::Purpose::partner);
      }
      const auto other = static_cast<ParticleIndex>((words[k % words.size()] * others_) >> 32U);
      result[k] = other + (other >= particle ? 1 : 0);
    }
  }
  /// Two numbers of (0, 1): whether it collides, and with which partner.
  std::array<double, 2> acceptance_draws(ParticleIndex particle) const {
    return pair(particle, random::Purpose::candidate);
  }
  /// Two numbers of (0, 1), for the line of centres.
  std::array<double, 2> direction(ParticleIndex particle) const {
    return pair(particle, random::Purpose::normal);
  }

 private:
  random::Counter counter(ParticleIndex particle, std::uint32_t group) const {
    return {.step = step_, .group = group, .item = particle};
  }
  std::array<double, 2> pair(ParticleIndex particle, random::Purpose purpose) const {
    const random::Words words = random::words(seed_, counter(particle, 0), purpose);
    return {open_unit(random::join(words[0], words[1])),
            open_unit(random::join(words[2], words[3]))};
  }

  std::uint64_t seed_;
  std::uint32_t step_;
  std::uint64_t others_;
};

/// Each particle takes one point of a shifted lattice, ordered by the first coordinate (L'Ecuyer,
/// Lecot & Tuffin 2008, array-RQMC).
/// Partners beyond the dimensions of the rule are drawn independently.
class LatticeDraws {
 public:
  LatticeDraws(const LatticeRule& rule, const IndependentDraws& further)
      : rule_(rule), further_(further) {}

  void partners(ParticleIndex particle, std::span<ParticleIndex> result) const {
    if (result.size() > kPartners) {
      further_.partners(particle, result);
    }
    const auto others = static_cast<double>(rule_.points() - 1);
    int dimension = kFirstPartner;
    for (ParticleIndex& partner : result.first(std::min(result.size(), kPartners))) {
      const auto other =
          static_cast<ParticleIndex>(rule_.coordinate(particle, dimension++) * others);
      partner = other + (other >= particle ? 1 : 0);
    }
  }
  std::array<double, 2> acceptance_draws(ParticleIndex particle) const {
    return {rule_.coordinate(particle, 1), rule_.coordinate(particle, 2)};
  }
  std::array<double, 2> direction(ParticleIndex particle) const {
    return {rule_.coordinate(particle, 3), rule_.coordinate(particle, 4)};
  }

 private:
  static constexpr int kFirstPartner = 5;
  static constexpr std::size_t kPartners = LatticeRule::kDimensions - kFirstPartner;

  const LatticeRule& rule_;
  const IndependentDraws& further_;
};

}  // namespace clca::boltzmann
