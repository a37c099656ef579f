// Samples of the two initial distributions of Ogawa & Kato 1982.

#include "clca/boltzmann/gas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "boltzmann/elementary.hpp"
#include "boltzmann/lattice_rule.hpp"
#include "boltzmann/rule/solid_collision.hpp"
#include "clca/random/draw.hpp"
#include "clca/random/words.hpp"
#include "clca/reflection/hash.hpp"

namespace clca::boltzmann {
namespace {

using Components = Vector3<double>;
using TripleList = std::vector<Components>;
using CubePoint = std::array<double, 6>;

constexpr std::uint32_t kBeginningShift = 0;

double squared(const Components& vector) {
  return dot(vector, vector);
}

Components scaled(const Components& vector, double factor) {
  return {vector.x * factor, vector.y * factor, vector.z * factor};
}

// Three numbers of (0, 1).
std::array<double, 3> three_draws(std::uint64_t seed, std::uint32_t item, random::Purpose purpose) {
  const random::Words first = random::words(seed, {.group = 0, .item = item}, purpose);
  const random::Words second = random::words(seed, {.group = 1, .item = item}, purpose);
  return {open_unit(random::join(first[0], first[1])), open_unit(random::join(first[2], first[3])),
          open_unit(random::join(second[0], second[1]))};
}

// Points of the unit cube: independent, or of a lattice.
class CubePoints {
 public:
  CubePoints(const InitialCondition& condition, std::uint64_t count, std::uint64_t seed)
      : seed_(seed) {
    if (condition.quasi) {
      rule_.emplace(count);
      rule_->shift(seed, {.step = 0, .group = kBeginningShift});
    }
  }

  CubePoint operator()(std::uint64_t number) const {
    CubePoint point{};
    if (rule_) {
      for (int dimension = 0; dimension < 6; ++dimension) {
        point.at(static_cast<std::size_t>(dimension)) = rule_->coordinate(number, dimension);
      }
      return point;
    }
    const auto item = static_cast<std::uint32_t>(number);
    const auto velocity = three_draws(seed_, item, random::Purpose::initial_velocity);
    const auto spin = three_draws(seed_, item, random::Purpose::initial_spin);
    // A direction takes two coordinates, and equal energies the first four.
    return {velocity[0], velocity[1], spin[0], spin[1], velocity[2], spin[2]};
  }

 private:
  std::uint64_t seed_;
  std::optional<LatticeRule> rule_;
};

// Box & Muller 1958.
std::pair<double, double> two_normals(double u, double turns) {
  const double radius = std::sqrt(-2 * logarithm(u));
  const auto [cosine, sine] = cosine_and_sine(turns);
  return {radius * cosine, radius * sine};
}

Components direction(double u, double turns) {
  const double z = 2 * u - 1;
  const double radius = std::sqrt(1 - z * z);
  const auto [cosine, sine] = cosine_and_sine(turns);
  return {radius * cosine, radius * sine, z};
}

struct UnitSample {
  // Empty, with capacity for `particles`.
  explicit UnitSample(std::uint64_t particles) {
    velocities.reserve(particles);
    spins.reserve(particles);
  }

  TripleList velocities;
  TripleList spins;  // of the same length in the mean as the velocities
};

// Mean 0 and mean square 3, by a shift and a factor.
void standardise(TripleList& vectors) {
  const auto count = static_cast<double>(vectors.size());
  Components sum{};
  for (const Components& vector : vectors) {
    sum = {sum.x + vector.x, sum.y + vector.y, sum.z + vector.z};
  }
  double square = 0;
  for (Components& vector : vectors) {
    vector = {vector.x - sum.x / count, vector.y - sum.y / count, vector.z - sum.z / count};
    square += squared(vector);
  }
  for (Components& vector : vectors) {
    vector = scaled(vector, std::sqrt(3 * count / square));
  }
}

UnitSample normal_sample(const InitialCondition& condition, std::uint64_t seed) {
  const CubePoints points(condition, condition.particles, seed);
  UnitSample sample(condition.particles);
  for (std::uint64_t particle = 0; particle < condition.particles; ++particle) {
    const CubePoint u = points(particle);
    const auto [v_x, v_y] = two_normals(u[0], u[1]);
    const auto [w_x, w_y] = two_normals(u[2], u[3]);
    const auto [v_z, w_z] = two_normals(u[4], u[5]);
    sample.velocities.push_back({v_x, v_y, v_z});
    sample.spins.push_back({w_x, w_y, w_z});
  }
  if (condition.exact_moments) {
    standardise(sample.velocities);
    standardise(sample.spins);
  }
  return sample;
}

// Three unit vectors with sum 0 in a random plane, made of two directions.
std::array<Components, 3> three_in_plane(const Components& first, const Components& other) {
  const Components across = cross(first, other);
  const Components side = scaled(across, std::sqrt(0.75 / squared(across)));
  const Components back = scaled(first, -0.5);
  return {first,
          {back.x + side.x, back.y + side.y, back.z + side.z},
          {back.x - side.x, back.y - side.y, back.z - side.z}};
}

// `count` unit vectors with sum 0: opposite pairs and, if `count` is odd, three that sum to 0. Uses
// the first (count + 1) / 2 directions.
TripleList balanced(const TripleList& directions, std::uint64_t count) {
  TripleList result;
  result.reserve(count);
  const std::uint64_t pairs = count % 2 == 0 ? count / 2 : (count - 3) / 2;
  for (std::uint64_t pair = 0; pair < pairs; ++pair) {
    result.push_back(directions[pair]);
    result.push_back(scaled(directions[pair], -1));
  }
  if (count % 2 == 1) {
    const auto three = three_in_plane(directions[pairs], directions[pairs + 1]);
    result.insert(result.end(), three.begin(), three.end());
  }
  return result;
}

UnitSample equal_sample(const InitialCondition& condition, std::uint64_t seed) {
  const std::uint64_t count =
      condition.exact_moments ? (condition.particles + 1) / 2 : condition.particles;
  const CubePoints points(condition, count, seed);
  UnitSample sample(count);
  for (std::uint64_t number = 0; number < count; ++number) {
    const CubePoint u = points(number);
    sample.velocities.push_back(direction(u[0], u[1]));
    sample.spins.push_back(direction(u[2], u[3]));
  }
  if (condition.exact_moments) {
    sample.velocities = balanced(sample.velocities, condition.particles);
    sample.spins = balanced(sample.spins, condition.particles);
    // Particles that share a velocity must not share a spin: v w^T would be the same for both.
    std::rotate(sample.spins.begin(), sample.spins.begin() + 1, sample.spins.end());
  }
  for (std::uint64_t particle = 0; particle < condition.particles; ++particle) {
    sample.velocities[particle] = scaled(sample.velocities[particle], std::numbers::sqrt3);
    sample.spins[particle] = scaled(sample.spins[particle], std::numbers::sqrt3);
  }
  return sample;
}

}  // namespace

std::uint64_t hash(const Gas& gas) {
  return reflection::hash(gas);
}

std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member) {
  return member == 0 ? seed : random::draw(seed, member, 0, random::Purpose::member);
}

Gas make_gas(const InitialCondition& condition, std::uint64_t seed) {
  if (condition.particles < 2) {
    throw std::invalid_argument("a gas needs at least 2 particles");
  }
  if (condition.particles > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("a gas has less than 2^32 particles");
  }
  if (!(condition.energy_ratio >= 0 && std::isfinite(condition.energy_ratio))) {
    throw std::invalid_argument("the ratio of energies must not be negative");
  }
  const UnitSample sample = condition.initial == Initial::gaussian ? normal_sample(condition, seed)
                                                                   : equal_sample(condition, seed);
  const double spin_scale = std::sqrt(kSolidSpin * condition.energy_ratio);
  Gas gas;
  gas.motions.resize(Eigen::NoChange, static_cast<Eigen::Index>(condition.particles));
  for (Eigen::Index particle = 0; particle < gas.particles(); ++particle) {
    const Components& v = sample.velocities[static_cast<std::size_t>(particle)];
    const Components w = scaled(sample.spins[static_cast<std::size_t>(particle)], spin_scale);
    gas.motions.col(particle) << v.x, v.y, v.z, w.x, w.y, w.z;
  }
  return gas;
}

}  // namespace clca::boltzmann
