#pragma once
// Placing particles: at random, or as a packing that is at rest from the start.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "clca/grains/model.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"
#include "clca/random/draw.hpp"
#include "grains/internal/box.hpp"

namespace clca::grains {

/// Throws std::invalid_argument unless there is one count for each species.
void check_counts(const State& state, std::span<const std::size_t> counts);

/// Throws std::invalid_argument if the mixture is not as described there.
void check_mixture(const State& state, const Mixture& mixture);

/// Places `counts` particles per species at random in free sites of `region`, larger species first,
/// in random orientations. A species that no longer fits is placed in part.
/// Ids are given by columns from the left, upwards. Throws as check_counts, check_valid.
FillResult fill_region(Box& box, const lattice::Rectangle& region,
                       std::span<const std::size_t> counts);

/// Sequential deposition (Visscher & Bolsterli 1972): drops particles one by one over random
/// columns of `region`; each falls and rolls down until it rests. Gravity points down.
/// `counts` per species, in random order. The bottom and sides of the region hold the particles; a
/// particle that does not fit is not placed. Ids and preconditions as for fill_region.
FillResult deposit_region(Box& box, const lattice::Rectangle& region,
                          std::span<const std::size_t> counts);

/// Fills the region with a mixture; at random, or as deposit_region. Where parts of a picture are
/// deposited, a particle that would come to rest in another part is not placed. Ids as for
/// fill_region. The mixture has to be checked.
FillResult fill_mixture(Box& box, const lattice::Rectangle& region, const Mixture& mixture);

/// The parts of a mixture, and the picture that says where they are.
struct MixtureParts {
  const std::vector<std::vector<std::uint32_t>>& weights;  ///< by part, then by species
  std::optional<lattice::Picture> picture;

  /// None where the picture is empty.
  std::optional<std::size_t> part_at(lattice::Site site) const {
    if (!picture) {
      return 0;
    }
    const auto part = static_cast<std::size_t>(
        lattice::pixel_at(*picture, lattice::position(site)) - Mixture::kFirstPart);
    return part < weights.size() ? std::optional(part) : std::nullopt;
  }
};

/// See fill_mixture.
FillResult deposit_mixture(Box& box, const lattice::Rectangle& region, const MixtureParts& parts,
                           std::optional<double> level);

// Single particles.

inline std::uint32_t next_id(const State& state) {
  return static_cast<std::uint32_t>(state.particles.size());
}

/// True if all sites of the particle are in the box and free.
bool fits(const Box& box, const Particle& particle);

/// True if every site of the particle is in the region.
bool lies_inside(const State& state, const Particle& particle, const lattice::Rectangle& region);

/// Appends the particle, which must fit.
void insert(Box& box, const Particle& particle);

/// The kinds of a species: one for each orientation.
std::vector<std::uint16_t> kinds_of(const State& state, std::size_t species);

/// An index, drawn by these bits in proportion to the weights, which are not all zero.
template <class Weights>
std::size_t weighted_index(const Weights& weights, std::uint64_t bits) {
  std::uint64_t rest = random::uniform_below(
      bits, std::accumulate(weights.begin(), weights.end(), std::uint64_t{0}));
  std::size_t index = 0;
  while (rest >= weights[index]) {
    rest -= weights[index++];
  }
  return index;
}

/// The species of the next particle, drawn in proportion to the weights.
template <class Weight>
std::size_t draw_species(const State& state, const std::vector<Weight>& weights) {
  return weighted_index(
      weights, random::draw(state.seed, 0, next_id(state), random::Purpose::deposit_species));
}

/// Renumbers the particles from `first` on, column by column from the left, upwards, so that
/// neighbours in the box are neighbours in memory.
void renumber(Box& box, std::size_t first);

}  // namespace clca::grains
