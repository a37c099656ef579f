#include "clca/measure/force.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "clca/measure/profile.hpp"
#include "measure/places.hpp"

namespace clca::measure {

namespace {

using grains::Occupancy;
using grains::Push;
using grains::State;
using grains::Wall;
using lattice::Direction;
using lattice::Site;

constexpr double kBehind = 1;  // lattice spacings: a wall's roughness on the lattice and a half

/// Calls `visit` with each site that two share.
template <class Visit>
void for_each_shared(const State& state, const Occupancy& occupancy, const OverlapContact& contact,
                     const Visit& visit) {
  const grains::Particle& particle = state.particles[contact.first];
  for (const lattice::Axial part : state.shape(particle).sites()) {
    const Site site = particle.site() + part;
    if (occupancy.has_owner(state.lattice.index(site), contact.second)) {
      visit(site);
    }
  }
}

/// See OverlapContact::depth.
int depth_of(const State& state, const Occupancy& occupancy, const OverlapContact& contact) {
  const grains::Particle& particle = state.particles[contact.first];
  const auto& parts = state.shape(particle).sites();
  const bool one_move = std::ranges::any_of(lattice::kDirections, [&](Direction direction) {
    const Site moved = particle.site() + unit(direction);
    return std::ranges::none_of(parts, [&](lattice::Axial part) {
      return occupancy.has_owner(state.lattice.index(moved + part), contact.second);
    });
  });
  return one_move ? 1 : 2;
}

/// Current sites of the wall, not wrapped at a periodic boundary, also outside the box.
std::vector<Site> shifted_sites(const Wall& wall) {
  std::vector<Site> sites = wall.sites;
  const lattice::Axial shift = wall.shift();
  for (Site& site : sites) {
    site = site + shift;
  }
  return sites;
}

/// The cone of 45 degrees ahead of a wall; in a periodic box of all its images.
class Cone {
 public:
  Cone(const State& state, const Wall& wall, Direction direction)
      : ahead_(lattice::position(unit(direction))), side_(-ahead_.y(), ahead_.x()) {
    if (state.lattice.periodic()) {
      period_ = lattice::kColumnPitch * state.lattice.columns();
    }
    for (const Site site : shifted_sites(wall)) {
      if (state.lattice.contains(site)) {
        add(lattice::position(site));
      }
    }
  }

  bool contains(const Eigen::Vector2d& point) const {
    if (left_ > right_) {
      return false;  // the wall has left the box
    }
    if (period_ == 0) {
      return holds(point);
    }
    const double nearest = std::round(((left_ + right_) / 2 - point.x()) / period_);
    return holds_image(point, nearest) || holds_image(point, nearest - 1) ||
           holds_image(point, nearest + 1);
  }

 private:
  void add(const Eigen::Vector2d& point) {
    foremost_ = std::max(foremost_, point.dot(ahead_));
    low_ = std::min(low_, point.dot(side_));
    high_ = std::max(high_, point.dot(side_));
    left_ = std::min(left_, point.x());
    right_ = std::max(right_, point.x());
  }

  bool holds_image(const Eigen::Vector2d& point, double image) const {
    return holds(point + Eigen::Vector2d(image * period_, 0));
  }

  bool holds(const Eigen::Vector2d& point) const {
    const double distance = point.dot(ahead_) - foremost_;
    const double lateral = point.dot(side_);
    const double wider = std::max(distance, 0.0) + kRoundingTolerance;
    return distance >= -kBehind - kRoundingTolerance && lateral >= low_ - wider &&
           lateral <= high_ + wider;
  }

  Eigen::Vector2d ahead_;  // unit vectors
  Eigen::Vector2d side_;
  double period_ = 0;  // lattice spacings; 0: not periodic
  // Of the sites of the wall in the box, lattice spacings:
  double foremost_ = -kInfinity;  // greatest coordinate along ahead_
  double low_ = kInfinity;        // bounds along side_
  double high_ = -kInfinity;
  double left_ = kInfinity;  // bounds of x
  double right_ = -kInfinity;
};

/// Between the two of a contact, in either direction; null if there is none.
const Push* push_between(const State& state, const OverlapContact& contact) {
  const Push* push = find_push(state, contact.first, contact.second);
  if (push == nullptr && grains::is_particle(contact.second)) {
    push = find_push(state, static_cast<std::uint32_t>(contact.second),
                     grains::as_owner(contact.first));
  }
  return push;
}

std::optional<double> cone_share(const State& state, const Occupancy& occupancy,
                                 const std::vector<OverlapContact>& contacts) {
  std::map<std::pair<std::uint32_t, Direction>, Cone> cones;
  std::uint64_t inside = 0;
  int all = 0;
  for (const OverlapContact& contact : contacts) {
    const Push* push = grains::is_particle(contact.second) ? push_between(state, contact) : nullptr;
    if (push == nullptr) {
      continue;
    }
    const auto key = std::pair(push->source, push->direction);
    auto cone = cones.find(key);
    if (cone == cones.end()) {
      const Wall& wall = state.walls[push->source];
      cone = cones.emplace(key, Cone(state, wall, push->direction)).first;
    }
    for_each_shared(state, occupancy, contact, [&](Site site) {
      inside += cone->second.contains(lattice::position(site)) ? 1U : 0U;
    });
    all += contact.shared_sites;
  }
  return all > 0 ? std::optional(static_cast<double>(inside) / all) : std::nullopt;
}

/// Particles at rest that were pushed, each once: by one wall or by any.
std::size_t jammed_count(const State& state, std::optional<std::size_t> source) {
  std::size_t count = 0;
  std::optional<std::uint32_t> last;  // pushes are in the order of `pushed`
  for (const Push& push : state.pushes) {
    const grains::Particle& pushed = state.particles[push.pushed];
    const bool jams = pushed.present && pushed.previous == grains::kRest;
    if (jams && push.pushed != last && (!source || push.source == *source)) {
      ++count;
      last = push.pushed;
    }
  }
  return count;
}

WallOverlap wall_overlap(const State& state, std::size_t number,
                         const std::vector<OverlapContact>& contacts) {
  const grains::Travel& travel = state.walls[number].travel;
  WallOverlap overlap{.wall = number,
                      .travel = travel.offset,
                      .stalled_since = travel.stalled_since,
                      .stalls = travel.stalls,
                      .jammed_particles = jammed_count(state, number)};
  for (const OverlapContact& contact : contacts) {
    const auto sites = static_cast<std::uint64_t>(contact.shared_sites);
    if (contact.second == grains::wall_code(number)) {
      ++overlap.overlapping_particles;
      overlap.shared_sites += sites;
    }
    overlap.chain_sites += contact.source_wall == number ? sites : 0;
  }
  return overlap;
}

constexpr double kAveragedBin = 0.25;  // of the mean
constexpr double kFirstNumberLow = 0.5;
constexpr double kMaxSites = 1e6;  // of a contact
constexpr double kMaxForce = 1e15;

/// Fits the exponential tail. Static packings have beta from 1.4 (Radjai et al. 1996) to 1.9 (Mueth
/// et al. 1998).
/// Averages: density beta exp(-beta (x - 1)) of x = f/<f> > 1, so beta is the inverse mean of x -
/// 1. Whole sites: a geometric distribution from the first integer above the mean; with m the mean
/// excess over it, beta = <f> log(1 + 1/m).
/// Treating whole sites as real numbers would bias beta if <f> is only a few sites.
void fit_tail(ForceDistribution& distribution, const std::vector<double>& strengths,
              StrengthKind kind) {
  const double mean = distribution.mean;
  const bool whole = kind == StrengthKind::whole_sites;
  const double start = whole ? std::floor(mean) + 1 : mean;
  double excess = 0;
  for (const double strength : strengths) {
    if (strength > mean * (1 + kRoundingTolerance)) {
      ++distribution.tail_contacts;
      excess += strength - start;
    }
  }
  if (distribution.tail_contacts < 2 || excess <= 0) {
    return;
  }
  excess /= static_cast<double>(distribution.tail_contacts);
  distribution.beta = whole ? mean * std::log1p(1 / excess) : mean / excess;
}

void fill_bins(ForceDistribution& distribution, const std::vector<double>& strengths,
               StrengthKind kind) {
  const bool whole = kind == StrengthKind::whole_sites;
  const double width = whole ? 1 : kAveragedBin * distribution.mean;
  const double low = whole ? kFirstNumberLow : 0;
  const auto bin_of = [&](double strength) {
    return static_cast<std::size_t>(std::max(0.0, part_at((strength - low) / width)));
  };
  distribution.bins.resize(bin_of(*std::ranges::max_element(strengths)) + 1);
  for (const double strength : strengths) {
    ++distribution.bins[bin_of(strength)].count;
  }
  const double unit = static_cast<double>(strengths.size()) * width / distribution.mean;
  for (std::size_t number = 0; number < distribution.bins.size(); ++number) {
    ForceBin& bin = distribution.bins[number];
    bin.low = low + width * static_cast<double>(number);
    bin.high = bin.low + width;
    bin.density = static_cast<double>(bin.count) / unit;
  }
}

}  // namespace

// Every overlapping pair has one push.
std::vector<OverlapContact> overlap_contacts(const State& state, const Occupancy& occupancy) {
  check_occupancy(state, occupancy);
  std::vector<OverlapContact> result;
  result.reserve(state.pushes.size());
  for (const Push& push : state.pushes) {
    const bool by_particle = grains::is_particle(push.pusher);
    const auto pusher = static_cast<std::uint32_t>(push.pusher);
    const bool swapped = by_particle && pusher < push.pushed;
    OverlapContact contact = {.first = swapped ? pusher : push.pushed,
                              .second = swapped ? grains::as_owner(push.pushed) : push.pusher,
                              .source_wall = push.source};
    for_each_shared(state, occupancy, contact, [&](Site site) {
      ++contact.shared_sites;
      contact.point += lattice::position(site);
    });
    contact.point = state.lattice.image_in_box(contact.point / std::max(1, contact.shared_sites));
    contact.depth = depth_of(state, occupancy, contact);
    result.push_back(contact);
  }
  std::ranges::sort(result, {}, [](const OverlapContact& contact) {
    return std::pair(contact.first, contact.second);
  });
  return result;
}

std::vector<double> force_indices(std::size_t particle_count,
                                  const std::vector<OverlapContact>& contacts) {
  std::vector<double> indices(particle_count, 0.0);
  for (const OverlapContact& contact : contacts) {
    const bool second_is_there = !grains::is_particle(contact.second) ||
                                 static_cast<std::size_t>(contact.second) < particle_count;
    require(contact.first < particle_count && second_is_there,
            "a contact is of a particle that is not there");
    indices[contact.first] += contact.shared_sites;
    if (grains::is_particle(contact.second)) {
      indices[static_cast<std::size_t>(contact.second)] += contact.shared_sites;
    }
  }
  return indices;
}

ForceSummary force_summary(const State& state, const Occupancy& occupancy,
                           const std::vector<OverlapContact>& contacts) {
  check_occupancy(state, occupancy);
  for (const OverlapContact& contact : contacts) {
    require(contact.first < state.particles.size(), "a contact is of a particle that is not there");
  }
  ForceSummary summary{.contact_count = contacts.size(),
                       .jammed_particles = jammed_count(state, {}),
                       .cone_share = cone_share(state, occupancy, contacts)};
  for (const OverlapContact& contact : contacts) {
    summary.max_depth = std::max(summary.max_depth, contact.depth);
    summary.shared_sites += static_cast<std::uint64_t>(contact.shared_sites);
  }
  for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
    if (state.walls[wall].motion) {
      summary.walls.push_back(wall_overlap(state, wall, contacts));
    }
  }
  return summary;
}

std::optional<double> penetration_depth(const State& now, const Wall& wall,
                                        const std::vector<double>& surface_at_start) {
  const bool down = wall.motion && wall.motion->direction == Direction::down;
  const bool up = wall.motion && wall.motion->direction == Direction::up;
  if (!wall.present || (!down && !up)) {
    return std::nullopt;
  }
  require(surface_at_start.size() == static_cast<std::size_t>(now.lattice.columns()),
          "a surface has one height for each column of the box");
  std::vector<double> covered(surface_at_start.size(), 0.0);
  // Height of the outermost edge above the floor of the box.
  double foremost = down ? kInfinity : -kInfinity;
  for (const Site site : shifted_sites(wall)) {
    const double height = lattice::position(site).y();
    foremost = down ? std::min(foremost, height) : std::max(foremost, height + 1);
    const int column = now.lattice.wrapped(site.column);
    if (column >= 0 && column < now.lattice.columns()) {
      const auto number = static_cast<std::size_t>(column);
      covered[number] = surface_at_start[number];
    }
  }
  const double surface = mean_height(covered);
  return surface > 0 ? std::optional(surface - foremost) : std::nullopt;
}

std::optional<ForceDistribution> force_distribution(const std::vector<double>& strengths,
                                                    StrengthKind kind) {
  if (strengths.empty()) {
    return std::nullopt;
  }
  const double most = kind == StrengthKind::whole_sites ? kMaxSites : kMaxForce;
  const bool usable = std::ranges::all_of(
      strengths, [&](double strength) { return strength > 0 && strength < most; });
  require(usable, "the strength of a contact is out of range");
  const auto count = static_cast<double>(strengths.size());
  ForceDistribution distribution{.mean = std::accumulate(strengths.begin(), strengths.end(), 0.0) /
                                         count};
  fit_tail(distribution, strengths, kind);
  distribution.share_above_mean = static_cast<double>(distribution.tail_contacts) / count;
  fill_bins(distribution, strengths, kind);
  return distribution;
}

void ForceAverage::add(const std::vector<OverlapContact>& contacts) {
  ++samples_;
  for (const OverlapContact& contact : contacts) {
    Sum& sum = sums_[{contact.first, contact.second}];
    sum.sites += static_cast<std::uint64_t>(contact.shared_sites);
    ++sum.samples;
  }
}

bool ForceAverage::precedes(const grains::State& now) const {
  return std::ranges::all_of(sums_, [&](const auto& pair) {
    const auto [first, second] = pair.first;
    const bool known =
        grains::is_particle(second)
            ? static_cast<std::size_t>(second) < now.particles.size()
            : grains::is_obstacle(second) && grains::wall_number(second) < now.walls.size();
    return known && first < now.particles.size();
  });
}

std::vector<ForceAverage::Mean> ForceAverage::means() const {
  std::vector<Mean> means;
  means.reserve(sums_.size());
  const auto samples = static_cast<double>(samples_);
  for (const auto& [pair, sum] : sums_) {
    means.push_back({.first = pair.first,
                     .second = pair.second,
                     .shared_sites = static_cast<double>(sum.sites) / samples,
                     .present_share = static_cast<double>(sum.samples) / samples});
  }
  return means;
}

}  // namespace clca::measure
