#include "clca/measure/mixing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "clca/baxter/baxter_model.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/profile.hpp"
#include "measure/places.hpp"

namespace clca::measure {

namespace {

using grains::Particle;
using grains::State;

/// Length of a vector in the box, by the nearest image where that is periodic.
double distance(const lattice::Lattice& lattice, Eigen::Vector2d between) {
  if (lattice.periodic()) {
    const double width = lattice.extent().x();
    between.x() -= width * std::round(between.x() / width);
  }
  return between.norm();
}

double average_diameter(const grains::State& state, const std::vector<std::uint32_t>& ids) {
  double sum = 0;
  for (const std::uint32_t id : ids) {
    sum += state.shape(state.particles[id]).diameter();
  }
  return ids.empty() ? 0 : sum / static_cast<double>(ids.size());
}

/// Sizes of the smallest and the largest particles present, in sites.
struct Sizes {
  std::size_t smallest = std::numeric_limits<std::size_t>::max();
  std::size_t largest = 0;

  bool differ() const { return smallest < largest; }
};

Sizes sizes_of(const State& state) {
  Sizes sizes;
  for_each_present(state, [&](std::uint32_t /*id*/, const Particle& particle) {
    const std::size_t size = state.shape(particle).size();
    sizes.smallest = std::min(sizes.smallest, size);
    sizes.largest = std::max(sizes.largest, size);
  });
  return sizes;
}

/// Mean height of the centres of mass of particles of this size.
double mean_height_of(const State& state, std::size_t size) {
  double sum = 0;
  double count = 0;
  for (const Particle& particle : state.particles) {
    if (particle.present && state.shape(particle).size() == size) {
      sum += grains::centre(state, particle).y();
      count += 1;
    }
  }
  return sum / count;
}

/// Vertical extent of particles: edges of sites, in lattice spacings above the floor of the box.
struct VerticalExtent {
  double bottom = kInfinity;
  double top = -kInfinity;

  void add(lattice::Site site) {
    const double height = lattice::position(site).y();
    bottom = std::min(bottom, height);
    top = std::max(top, height + 1);
  }
};

/// Height of the bed as defined at segregation_index. Precondition: there is a particle.
double bed_height(const State& state) {
  double sum = 0;
  double count = 0;
  VerticalExtent extent;
  for_each_site(state, [&](lattice::Site site) {
    extent.add(site);
    sum += lattice::position(site).y() + 0.5;
    count += 1;
  });
  return 2 * (sum / count - extent.bottom);
}

/// Id of the only particle of the only species with exactly one; none otherwise.
std::optional<std::uint32_t> intruder(const State& state) {
  struct Members {
    std::size_t count = 0;
    std::uint32_t last = 0;  // id
  };
  std::map<std::uint16_t, Members> species;
  for_each_present(state, [&](std::uint32_t id, const Particle& particle) {
    Members& members = species[state.kinds[particle.kind].species];
    members = {members.count + 1, id};
  });
  const auto alone = [](const auto& entry) { return entry.second.count == 1; };
  if (std::ranges::count_if(species, alone) != 1) {
    return std::nullopt;
  }
  return std::ranges::find_if(species, alone)->second.last;
}

}  // namespace

std::vector<int> coordination_numbers(const State& state, const grains::Occupancy& occupancy) {
  check_occupancy(state, occupancy);
  std::vector<int> result(state.particles.size(), 0);
  std::vector<grains::Owner> touched;
  for_each_present(state, [&](std::uint32_t id, const Particle& particle) {
    touched = {grains::kFree, grains::as_owner(id)};
    const auto add = [&](lattice::Site site) {
      const std::size_t index = state.lattice.index(site);
      for (const grains::Owner owner : {occupancy.owner(index), occupancy.second_owner(index)}) {
        if (std::ranges::find(touched, owner) == touched.end()) {
          touched.push_back(owner);
        }
      }
    };
    for (const lattice::Axial part : state.shape(particle).sites()) {
      const lattice::Site site = particle.site() + part;
      add(site);
      for (const lattice::Direction direction : lattice::kDirections) {
        add(site + unit(direction));
      }
    }
    result[id] = static_cast<int>(touched.size()) - 2;
  });
  return result;
}

std::optional<double> axis_order(const State& state) {
  using lattice::Direction;
  const grains::Occupancy occupancy(state);
  double pairs = 0;
  double equal = 0;
  for_each_present(state, [&](std::uint32_t /*id*/, const Particle& grain) {
    for (const Direction direction : {Direction::up, Direction::up_right, Direction::down_right}) {
      const grains::Owner owner =
          occupancy.owner(state.lattice.index(grain.site() + unit(direction)));
      if (grains::is_particle(owner)) {
        const Particle& neighbour = state.particles[grains::particle_id(owner)];
        pairs += 1;
        equal += baxter::axis_of(grain) == baxter::axis_of(neighbour) ? 1 : 0;
      }
    }
  });
  return pairs > 0 ? std::optional(equal / pairs) : std::nullopt;
}

Mixing::Mixing(const grains::State& state) : begin_(state) {
  std::vector<Eigen::Vector2d> centres;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    centres.push_back(grains::centre_in_box(state, state.particles[id]));
    if (state.particles[id].present) {
      ids.push_back(id);
    }
  }
  diameter_ = average_diameter(state, ids);
  // By height, so that neighbours are not far apart in the order.
  std::ranges::stable_sort(ids, {}, [&](std::uint32_t id) { return centres[id].y(); });
  const double near = kMaxNeighbourDistance * diameter_;
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
  for_each_present(now, [&](std::uint32_t id, const Particle& /*particle*/) {
    paths[id] = begin_.displacement(now, id);
  });
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
    sums.kept += distance(now.lattice, between) <= kMaxKeptDistance * diameter_ ? 1U : 0U;
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

std::optional<double> segregation_index(const State& state) {
  const Sizes sizes = sizes_of(state);
  if (!sizes.differ()) {
    return std::nullopt;
  }
  const double apart = mean_height_of(state, sizes.largest) - mean_height_of(state, sizes.smallest);
  return apart / (bed_height(state) / 2);
}

std::optional<double> lacey_index(const State& state, double cell) {
  struct Count {
    double all = 0;
    double large = 0;
  };
  const Sizes sizes = sizes_of(state);
  if (!sizes.differ()) {
    return std::nullopt;
  }
  const Grid grid(state.lattice, cell);
  const double sites = state.lattice.columns() * static_cast<double>(state.lattice.rows());
  if (sites / static_cast<double>(grid.size()) < 2 * static_cast<double>(sizes.largest)) {
    return std::nullopt;
  }
  std::vector<Count> counts(grid.size());
  Count total;
  for_each_present(state, [&](std::uint32_t /*id*/, const Particle& particle) {
    const double large = state.shape(particle).size() == sizes.largest ? 1 : 0;
    grid.share_out(grains::centre_in_box(state, particle), [&](std::size_t index, double share) {
      Count& count = counts[index];
      count = {count.all + share, count.large + share * large};
    });
    total = {total.all + 1, total.large + large};
  });
  double variance = 0;
  double cells = 0;
  const double share = total.large / total.all;
  for (const Count& count : counts) {
    if (count.all > 0) {
      variance += count.all / total.all * std::pow(count.large / count.all - share, 2);
      cells += 1;
    }
  }
  if (cells >= total.all) {
    return std::nullopt;
  }
  const double separated = share * (1 - share);
  return (separated - variance) / (separated * (1 - (cells - 1) / (total.all - 1)));
}

std::optional<double> intruder_height(const State& state) {
  const std::optional<std::uint32_t> id = intruder(state);
  if (!id) {
    return std::nullopt;
  }
  State others = state;
  others.particles[*id].present = false;
  const double surface = mean_height(surface_profile(others));
  VerticalExtent bed;
  for_each_site(state, [&](lattice::Site site) { bed.add(site); });
  const Particle& particle = state.particles[*id];
  VerticalExtent own;
  for (const lattice::Axial part : state.shape(particle).sites()) {
    own.add(particle.site() + part);
  }
  const double range = surface - (own.top - own.bottom) - bed.bottom;
  return range > 0 ? std::optional((own.bottom - bed.bottom) / range) : std::nullopt;
}

}  // namespace clca::measure
