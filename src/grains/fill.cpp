#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"
#include "lattice/internal/require.hpp"

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
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](std::size_t species) { return sizes[species]; });
  return order;
}

/// Tries every position once in random order (Fisher-Yates, as far as needed). A position that has
/// failed once never fits again.
class Trials {
 public:
  /// Positions at these sites in these orientations. Different keys give different orders.
  Trials(Box& box, const std::vector<lattice::Site>& sites, const std::vector<std::uint16_t>& kinds,
         std::uint32_t key)
      : key_(key) {
    trials_.reserve(sites.size() * kinds.size());
    for (const lattice::Site site : sites) {
      box.check_interruption();
      for (const std::uint16_t kind : kinds) {
        trials_.push_back({site, kind});
      }
    }
  }

  /// False if there is no position left.
  bool place_one(Box& box, const lattice::Rectangle& region) {
    const State& state = box.state;
    while (tried_ < trials_.size()) {
      box.check_interruption();
      const std::uint64_t bits =
          random::draw(state.seed, tried_, key_, random::Purpose::fill_position);
      std::swap(trials_[tried_],
                trials_[tried_ + random::uniform_below(bits, trials_.size() - tried_)]);
      const Trial& trial = trials_[tried_++];
      const Particle particle = {
          .column = trial.site.column, .row = trial.site.row, .kind = trial.kind};
      if (lies_inside(state, particle, region) && fits(box, particle)) {
        insert(box, particle);
        return true;
      }
    }
    return false;
  }

 private:
  std::vector<Trial> trials_;
  std::uint32_t key_;
  std::size_t tried_ = 0;
};

/// Places particles drawn by the weights on these sites until one has no room.
void fill_part(Box& box, const lattice::Rectangle& region, const std::vector<lattice::Site>& sites,
               const std::vector<std::uint32_t>& weights, std::vector<std::size_t>& placed) {
  const State& state = box.state;
  std::vector<Trials> trials;
  for (std::size_t species = 0; species < weights.size(); ++species) {
    const std::vector<std::uint16_t> kinds =
        weights[species] > 0 ? kinds_of(state, species) : std::vector<std::uint16_t>();
    trials.emplace_back(box, sites, kinds, next_id(state) + static_cast<std::uint32_t>(species));
  }
  std::size_t species = draw_species(state, weights);
  while (trials[species].place_one(box, region)) {
    ++placed[species];
    species = draw_species(state, weights);
  }
}

}  // namespace

double fill_trial_bytes(double sites, double orientations) {
  return sites * (sizeof(lattice::Site) + sizeof(Trial) * orientations);
}

void check_counts(const State& state, std::span<const std::size_t> counts) {
  std::size_t species = 0;
  for (const Kind& kind : state.kinds) {
    species = std::max<std::size_t>(species, kind.species + 1U);
  }
  require(counts.size() == species, "a fill needs one count for each species");
}

void check_mixture(const State& state, const Mixture& mixture) {
  for (const std::vector<std::uint32_t>& part : mixture.part_weights) {
    const std::vector<std::size_t> weights(part.begin(), part.end());
    check_counts(state, weights);
    require(std::ranges::any_of(part, [](auto weight) { return weight > 0; }),
            "the weights of a mixture are all zero");
  }
  require(!mixture.part_weights.empty() &&
              (!mixture.picture_rows.empty() || mixture.part_weights.size() == 1),
          "a mixture needs one part, or a picture of its parts");
  require(std::ranges::none_of(mixture.picture_rows,
                               [](const std::string& row) { return row.empty(); }),
          "a picture needs pixels");
}

FillResult fill_region(Box& box, const lattice::Rectangle& region,
                       std::span<const std::size_t> counts) {
  const State& state = box.state;
  const std::size_t first = state.particles.size();
  const std::vector<lattice::Site> sites = lattice::sites_in(state.lattice, region);
  FillResult result;
  result.placed_by_species.resize(counts.size(), 0);
  for (const std::size_t species : largest_first(state, counts.size())) {
    if (counts[species] == 0) {
      continue;
    }
    Trials trials(box, sites, kinds_of(state, species), next_id(state));
    while (result.placed_by_species[species] < counts[species] && trials.place_one(box, region)) {
      ++result.placed_by_species[species];
    }
    result.complete = result.complete && result.placed_by_species[species] == counts[species];
  }
  renumber(box, first);
  return result;
}

FillResult fill_mixture(Box& box, const lattice::Rectangle& region, const Mixture& mixture) {
  const State& state = box.state;
  const std::size_t first = state.particles.size();
  MixtureParts parts = {mixture.part_weights, {}};
  if (!mixture.picture_rows.empty()) {
    parts.picture = {.box = region, .rows = mixture.picture_rows};
  }
  FillResult result;
  if (mixture.deposited) {
    result = deposit_mixture(box, region, parts, mixture.surface_level);
  } else {
    result.placed_by_species.resize(mixture.part_weights.front().size(), 0);
    const std::vector<lattice::Site> sites = lattice::sites_in(state.lattice, region);
    for (std::size_t part = 0; part < parts.weights.size(); ++part) {
      std::vector<lattice::Site> own;
      std::ranges::copy_if(sites, std::back_inserter(own),
                           [&](lattice::Site site) { return parts.part_at(site) == part; });
      fill_part(box, region, own, parts.weights[part], result.placed_by_species);
    }
  }
  renumber(box, first);
  return result;
}

std::vector<std::uint16_t> kinds_of(const State& state, std::size_t species) {
  std::vector<std::uint16_t> kinds;
  for (std::size_t kind = 0; kind < state.kinds.size(); ++kind) {
    if (state.kinds[kind].species == species) {
      kinds.push_back(static_cast<std::uint16_t>(kind));
    }
  }
  return kinds;
}

bool fits(const Box& box, const Particle& particle) {
  const lattice::Lattice& lattice = box.state.lattice;
  const auto& sites = box.state.shape(particle).sites();
  return std::ranges::all_of(sites, [&](lattice::Axial offset) {
    const lattice::Site site = particle.site() + offset;
    return lattice.contains(site) && !box.occupancy.is_taken(lattice.index(site));
  });
}

bool lies_inside(const State& state, const Particle& particle, const lattice::Rectangle& region) {
  const auto& sites = state.shape(particle).sites();
  return std::ranges::all_of(sites, [&](lattice::Axial offset) {
    const lattice::Site site = particle.site() + offset;
    return region.contains(
        lattice::position(lattice::Site{state.lattice.wrapped(site.column), site.row}));
  });
}

void insert(Box& box, const Particle& particle) {
  const auto id = as_owner(box.state.particles.size());
  box.for_each_index(particle, [&](std::size_t index) { box.occupancy.take(index, id); });
  box.state.particles.push_back(particle);
  box.state.origins.push_back(particle.site());
}

void renumber(Box& box, std::size_t first) {
  std::vector<Particle>& particles = box.state.particles;
  std::sort(particles.begin() + static_cast<std::ptrdiff_t>(first), particles.end(),
            [](const Particle& a, const Particle& b) { return a.site() < b.site(); });
  for (std::size_t id = first; id < particles.size(); ++id) {
    box.state.origins[id] = particles[id].site();
    box.for_each_index(particles[id],
                       [&](std::size_t index) { box.occupancy.take(index, as_owner(id)); });
  }
}

}  // namespace clca::grains
