#pragma once
// What a particle draws in a step of the scheme of Ogawa & Kato: independently of all others, or
// as a point of a lattice.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "boltzmann/elementary.hpp"
#include "boltzmann/lattice_rule.hpp"
#include "random/words.hpp"

namespace clca::boltzmann {

/// A particle, or its rank where they are sorted.
using Place = std::uint32_t;

class IndependentDraws {
 public:
  IndependentDraws(std::uint64_t seed, std::uint64_t step, std::uint64_t particles)
      : seed_(seed), step_(static_cast<std::uint32_t>(step)), others_(particles - 1) {}

  /// Any but `place` itself, the same more than once if chance has it.
  void partners(Place place, std::span<Place> result) const {
    random::Words words{};
    for (std::uint32_t k = 0; k < result.size(); ++k) {
      if (k % words.size() == 0) {
        words = random::words(seed_, counter(place, static_cast<std::uint32_t>(k / words.size())),
                              random::Purpose::partner);
      }
      const auto other = static_cast<Place>((words[k % words.size()] * others_) >> 32U);
      result[k] = other + (other >= place ? 1 : 0);
    }
  }
  /// Two numbers of (0, 1): whether it collides, and with which partner.
  std::array<double, 2> verdict(Place place) const {
    return pair(place, random::Purpose::candidate);
  }
  /// Two numbers of (0, 1), for the line of centres.
  std::array<double, 2> direction(Place place) const {
    return pair(place, random::Purpose::normal);
  }

 private:
  random::Counter counter(Place place, std::uint32_t group) const {
    return {.step = step_, .group = group, .item = place};
  }
  std::array<double, 2> pair(Place place, random::Purpose purpose) const {
    const random::Words words = random::words(seed_, counter(place, 0), purpose);
    return {open_unit(random::join(words[0], words[1])),
            open_unit(random::join(words[2], words[3]))};
  }

  std::uint64_t seed_;
  std::uint32_t step_;
  std::uint64_t others_;
};

/// Each place takes one point of a shifted lattice, ascending in the coordinate that stands for
/// the place (L'Ecuyer, Lecot & Tuffin 2008, array-RQMC). Partners that find no dimension left are
/// drawn independently.
class LatticeDraws {
 public:
  LatticeDraws(const LatticeRule& rule, const IndependentDraws& further)
      : rule_(rule), further_(further) {}

  void partners(Place place, std::span<Place> result) const {
    if (result.size() > kPartners) {
      further_.partners(place, result);
    }
    const auto others = static_cast<double>(rule_.points() - 1);
    int dimension = kFirstPartner;
    for (Place& partner : result.first(std::min(result.size(), kPartners))) {
      const auto other = static_cast<Place>(rule_.coordinate(place, dimension++) * others);
      partner = other + (other >= place ? 1 : 0);
    }
  }
  std::array<double, 2> verdict(Place place) const {
    return {rule_.coordinate(place, 1), rule_.coordinate(place, 2)};
  }
  std::array<double, 2> direction(Place place) const {
    return {rule_.coordinate(place, 3), rule_.coordinate(place, 4)};
  }

 private:
  static constexpr int kFirstPartner = 5;
  static constexpr std::size_t kPartners = LatticeRule::kDimensions - kFirstPartner;

  const LatticeRule& rule_;
  const IndependentDraws& further_;
};

}  // namespace clca::boltzmann
