#include "clca/measure/weight_paths.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "clca/random/draw.hpp"
#include "measure/places.hpp"

namespace clca::measure {

namespace {

using Eigen::Vector2d;
using Support = SupportedGrain::Support;

constexpr double kMinNormalY = 0.05;  // of a unit normal: at least 2.9 degrees from the horizontal
constexpr double kAligned = 1e-9;     // radians

/// A force on a support.
struct SupportForce {
  grains::Owner body;
  Vector2d force;
};

/// From one direction to another, anticlockwise, in radians.
double angle(const Vector2d& from, const Vector2d& to) {
  return std::atan2(cross_product(from, to), from.dot(to));
}

/// A support to one side of a force; one in its direction is on both sides.
struct SupportAngle {
  double angle;  // not negative
  const Support* support;
};

/// `sign`: 1 for the supports that are anticlockwise of the force, -1 for the others.
std::vector<SupportAngle> supports_on_side(const Vector2d& force,
                                           const std::vector<Support>& supports, int sign) {
  std::vector<SupportAngle> result;
  for (const Support& support : supports) {
    const double turned = sign * angle(force, support.direction);
    if (turned >= -kAligned) {
      result.push_back({std::max(turned, 0.0), &support});
    }
  }
  std::ranges::stable_sort(result, {}, &SupportAngle::angle);
  return result;
}

const SupportAngle& chosen(const std::vector<SupportAngle>& all, WeightRule rule,
                           std::uint64_t bits) {
  if (rule == WeightRule::pair) {
    return all[random::uniform_below(bits, all.size())];
  }
  return rule == WeightRule::inner ? all.front() : all.back();
}

/// The force as two along a support to its left and one to its right. Adds to `outside` if it
/// points past all supports: friction would have to hold it.
std::vector<SupportForce> forces_along_two(const Vector2d& force, const SupportedGrain& grain,
                                           WeightRule rule, std::uint64_t bits,
                                           std::size_t& outside) {
  const std::vector<SupportAngle> left = supports_on_side(force, grain.supports, -1);
  const std::vector<SupportAngle> right = supports_on_side(force, grain.supports, 1);
  if (left.empty() || right.empty()) {
    ++outside;
    return {{(left.empty() ? right : left).front().support->body, force}};
  }
  const SupportAngle& one = chosen(left, rule, bits);
  const SupportAngle& other = chosen(right, rule, bits << 32U);
  for (const SupportAngle* aligned : {&one, &other}) {
    if (aligned->angle <= kAligned) {
      return {{aligned->support->body, force}};
    }
  }
  const Vector2d& a = one.support->direction;
  const Vector2d& b = other.support->direction;
  const double both = cross_product(a, b);
  return {{one.support->body, cross_product(force, b) / both * a},
          {other.support->body, cross_product(a, force) / both * b}};
}

/// Divides the vertical part of the force in drawn shares, one draw for each support from `first`.
std::vector<SupportForce> forces_in_shares(const grains::State& state, const Vector2d& force,
                                           const std::vector<Support>& supports,
                                           std::uint32_t first) {
  constexpr double kDraws = 4503599627370496;  // 2^52
  std::vector<double> shares;
  for (std::uint32_t i = 0; i < supports.size(); ++i) {
    const std::uint64_t bits =
        random::draw(state.seed, state.step, first + i, random::Purpose::weight_share);
    shares.push_back((static_cast<double>(bits >> 12U) + 0.5) / kDraws);
  }
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<SupportForce> result;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    result.push_back({supports[i].body, {0, shares[i] / all * force.y()}});
  }
  return result;
}

/// The same as a force of the contact model, with the same points on floor and walls.
contact::Force as_contact_force(const grains::State& state, std::uint32_t id,
                                const SupportForce& on_support) {
  const grains::Particle& grain = state.particles[id];
  const Vector2d centre = grains::centre_in_box(state, grain);
  contact::Force result = {.upper = id, .other = on_support.body};
  result.normal_force = on_support.force.norm();
  result.normal = -on_support.force / result.normal_force;
  result.branch = on_support.body == contact::kFloor
                      ? Vector2d(0, centre.y() - lattice::Lattice::lower_left_corner().y())
                      : Vector2d(state.shape(grain).diameter() / 2 * result.normal);
  result.point = state.lattice.image_in_box(centre - result.branch);
  return result;
}

}  // namespace

std::map<grains::Owner, lattice::Axial> touched_bodies(const grains::State& state,
                                                       const grains::Occupancy& occupancy,
                                                       std::uint32_t id) {
  std::map<grains::Owner, lattice::Axial> result;
  const grains::Particle& grain = state.particles[id];
  for (const lattice::Axial part : state.shape(grain).sites()) {
    for (const lattice::Direction direction : lattice::kDirections) {
      const lattice::Site site = grain.site() + part + unit(direction);
      const grains::Owner owner = occupancy.owner(state.lattice.index(site));
      if (owner != grains::kFree && owner != grains::as_owner(id) &&
          (owner != contact::kFloor || site.row < 0)) {  // kFloor is the code of the whole border
        lattice::Axial& sum = result[owner];
        sum = sum + unit(direction);
      }
    }
  }
  return result;
}

std::vector<SupportedGrain> supported_grains(const grains::State& state,
                                             const grains::Occupancy& occupancy) {
  check_occupancy(state, occupancy);
  require(!grains::walls_may_overlap(state), "particles that overlap do not rest on one another");
  std::vector<double> heights;
  std::vector<SupportedGrain> result;
  heights.reserve(state.particles.size());  // as weight_paths_bytes() has it
  result.reserve(state.particles.size());
  for (std::uint32_t id = 0; id < state.particles.size(); ++id) {
    heights.push_back(grains::centre(state, state.particles[id]).y());
    if (state.particles[id].present) {
      result.push_back({.id = id});
    }
  }
  const auto is_before = [&](std::uint32_t one, std::uint32_t other) {
    return heights[one] != heights[other] ? heights[one] > heights[other] : one < other;
  };
  std::ranges::sort(
      result, [&](const auto& one, const auto& other) { return is_before(one.id, other.id); });
  for (SupportedGrain& grain : result) {
    for (const auto& [body, sum] : touched_bodies(state, occupancy, grain.id)) {
      const bool is_grain = grains::is_particle(body);
      if (sum == lattice::Axial() ||
          (is_grain && !is_before(grain.id, grains::particle_id(body)))) {
        continue;
      }
      const Vector2d direction =
          body == contact::kFloor ? Vector2d(0, -1) : lattice::position(sum).normalized();
      if (direction.y() < -kMinNormalY) {
        grain.supports.push_back({body, direction});
      }
    }
  }
  return result;
}

WeightPaths weight_paths(const grains::State& state, const std::vector<SupportedGrain>& grains,
                         WeightRule rule) {
  WeightPaths result;
  const double mean_mass = contact::mean_grain_mass(state);
  std::vector<Vector2d> received(state.particles.size(), Vector2d::Zero());
  result.forces.reserve(
      std::transform_reduce(grains.begin(), grains.end(), std::size_t{0}, std::plus(),
                            [](const SupportedGrain& grain) { return grain.supports.size(); }));
  std::uint32_t draws = 0;
  for (const SupportedGrain& grain : grains) {
    if (grain.supports.empty()) {
      ++result.unsupported_grains;
      continue;
    }
    const auto sites = static_cast<double>(state.shape(state.particles[grain.id]).size());
    const Vector2d force = received[grain.id] - Vector2d(0, sites / mean_mass);
    const std::vector<SupportForce> all =
        rule == WeightRule::q ? forces_in_shares(state, force, grain.supports, draws)
                              : forces_along_two(force, grain, rule,
                                                 random::draw(state.seed, state.step, grain.id,
                                                              random::Purpose::weight_pair),
                                                 result.one_sided_grains);
    draws += static_cast<std::uint32_t>(grain.supports.size());
    for (const SupportForce& on_support : all) {
      if (grains::is_particle(on_support.body)) {
        received[grains::particle_id(on_support.body)] += on_support.force;
      }
      result.forces.push_back(as_contact_force(state, grain.id, on_support));
    }
  }
  return result;
}

BedBase bed_base(const grains::State& state) {
  constexpr double kLeftOut = 0.01;               // of the sites, on either side
  std::vector<std::pair<double, double>> grains;  // position and sites
  double all = 0;
  for_each_present(state, [&](std::uint32_t /*id*/, const grains::Particle& grain) {
    const auto sites = static_cast<double>(state.shape(grain).size());
    grains.emplace_back(grains::centre_in_box(state, grain).x(), sites);
    all += sites;
  });
  std::ranges::sort(grains);
  const auto end = [&](auto from, auto to) {
    double sites = 0;
    const auto at = std::find_if(from, to, [&](const auto& grain) {
      sites += grain.second;
      return sites > kLeftOut * all;
    });
    return at == to ? 0 : at->first;
  };
  return {end(grains.begin(), grains.end()), end(grains.rbegin(), grains.rend())};
}

std::vector<double> base_pressures(const BedBase& base, const std::vector<contact::Force>& forces) {
  std::vector<double> bins(BedBase::kBinCount, 0);
  for (const contact::Force& force : forces) {
    const double position = (force.point.x() - base.left) / base.width() * BedBase::kBinCount;
    if (!grains::is_particle(force.other) && force.normal.y() > kMinNormalY &&
        position >= -kRoundingTolerance && position <= BedBase::kBinCount + kRoundingTolerance) {
      share_out(position, BedBase::kBinCount,
                [&](std::size_t bin, double share) { bins[bin] += share * force.on_upper().y(); });
    }
  }
  const double mean = std::accumulate(bins.begin(), bins.end(), 0.0) / BedBase::kBinCount;
  if (mean == 0) {
    return {};
  }
  for (double& bin : bins) {
    bin /= mean;
  }
  return bins;
}

double centre_minus_ring(const std::vector<double>& pressure) {
  constexpr std::size_t kMiddle = BedBase::kBinCount / 2;
  double ring = 0;
  for (std::size_t i = 1; i <= 3; ++i) {
    ring += pressure[kMiddle - i] + pressure[kMiddle + i];
  }
  return pressure[kMiddle] - ring / 6;
}

}  // namespace clca::measure
