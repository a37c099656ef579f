#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"
#include "grains/placement.hpp"

namespace clca::grains {

namespace {

/// A position to try: a site of the region and a kind of the species.
struct Trial {
  lattice::Site site;
  std::uint16_t kind = 0;
};

/// Species indices with the largest shapes first.
std::vector<std::size_t> largest_first(const State& state, std::size_t species_count) {
  std::vector<std::size_t> sizes(species_count, 0);
  for (const Kind& kind : state.kinds) {
    sizes[kind.species] = kind.shape.size();
  }
  std::vector<std::size_t> order(species_count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  return order;
}

std::vector<Trial> all_trials(const std::vector<lattice::Site>& sites,
                              const std::vector<std::uint16_t>& kinds) {
  std::vector<Trial> trials;
  trials.reserve(sites.size() * kinds.size());
  for (const lattice::Site site : sites) {
    for (const std::uint16_t kind : kinds) {
      trials.push_back({site, kind});
    }
  }
  return trials;
}

/// Tries every position once in random order (Fisher-Yates, as far as needed). A position that has
/// failed once never fits again.
std::size_t place_species(State& state, OccupancyTable& occupancy, const lattice::Rectangle& region,
                          std::vector<Trial> trials, std::size_t count) {
  const auto first_id = static_cast<std::uint32_t>(state.particles.size());
  std::size_t placed = 0;
  for (std::size_t i = 0; i < trials.size() && placed < count; ++i) {
    const std::uint64_t bits =
        random::draw(state.seed, i, first_id, random::Purpose::fill_position);
    std::swap(trials[i], trials[i + random::below(bits, trials.size() - i)]);
    const Particle particle = {
        .column = trials[i].site.column, .row = trials[i].site.row, .kind = trials[i].kind};
    if (lies_inside(state, particle, region) && fits(state, occupancy, particle)) {
      insert(state, occupancy, particle);
      ++placed;
    }
  }
  return placed;
}

}  // namespace

void check_counts(const State& state, std::span<const std::size_t> counts) {
  std::size_t species = 0;
  for (const Kind& kind : state.kinds) {
    species = std::max<std::size_t>(species, kind.species + 1U);
  }
  if (counts.size() != species) {
    throw std::invalid_argument("a fill needs one count for each species");
  }
}

FillResult fill_region(State& state, OccupancyTable& occupancy, const lattice::Rectangle& region,
                       std::span<const std::size_t> counts) {
  const std::size_t first = state.particles.size();
  const std::vector<lattice::Site> sites = lattice::sites_in(state.lattice, region);
  FillResult result;
  result.placed.resize(counts.size(), 0);
  for (const std::size_t species : largest_first(state, counts.size())) {
    if (counts[species] == 0) {
      continue;
    }
    result.placed[species] = place_species(
        state, occupancy, region, all_trials(sites, kinds_of(state, species)), counts[species]);
    result.complete = result.complete && result.placed[species] == counts[species];
  }
  renumber(state, occupancy, first);
  return result;
}

}  // namespace clca::grains
