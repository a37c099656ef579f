// Samples of the two initial distributions of Ogawa & Kato 1982.

#include "clca/boltzmann/gas.hpp"

#include <Eigen/Geometry>
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

using Eigen::Array3d;
using Eigen::Array3Xd;
using CubePoint = std::array<double, 6>;

constexpr std::uint32_t kBeginningShift = 0;  // Counter::group; others are those of steps

// Three numbers of (0, 1).
std::array<double, 3> three_draws(std::uint64_t seed, std::uint32_t item, random::Purpose purpose) {
  const random::Words first = random::drawn_words(seed, {.group = 0, .item = item}, purpose);
  const random::Words second = random::drawn_words(seed, {.group = 1, .item = item}, purpose);
  return {open_uniform(random::joined(first[0], first[1])),
          open_uniform(random::joined(first[2], first[3])),
          open_uniform(random::joined(second[0], second[1]))};
}

// Points of the unit cube: independent, or of a lattice.
class CubePoints {
 public:
  CubePoints(const InitialCondition& condition, std::uint64_t count, std::uint64_t seed)
      : seed_(seed) {
    if (condition.quasi_random) {
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

Array3d direction(double u, double turns) {
  const double z = 2 * u - 1;
  const double radius = std::sqrt(1 - z * z);
  const auto [cosine, sine] = cosine_and_sine(turns);
  return {radius * cosine, radius * sine, z};
}

// Mean 0 and mean square 3, by a shift and a factor.
void standardise(Eigen::Ref<Array3Xd> vectors) {
  const auto count = static_cast<double>(vectors.cols());
  Array3d sum = Array3d::Zero();
  for (const auto& vector : vectors.colwise()) {
    sum += vector;
  }
  const Array3d mean = sum / count;
  double square = 0;
  for (auto vector : vectors.colwise()) {
    vector -= mean;
    square += squared(vector);
  }
  vectors *= std::sqrt(3 * count / square);
}

// Spins have the same mean square as velocities; so also in equal_energy_sample().
Motions normal_sample(const InitialCondition& condition, std::uint64_t seed) {
  const CubePoints points(condition, condition.particle_count, seed);
  Motions sample(6, static_cast<Eigen::Index>(condition.particle_count));
  for (Eigen::Index particle = 0; particle < sample.cols(); ++particle) {
    const CubePoint u = points(static_cast<std::uint64_t>(particle));
    const auto [v_x, v_y] = two_normals(u[0], u[1]);
    const auto [w_x, w_y] = two_normals(u[2], u[3]);
    const auto [v_z, w_z] = two_normals(u[4], u[5]);
    sample.col(particle) << v_x, v_y, v_z, w_x, w_y, w_z;
  }
  if (condition.exact_moments) {
    standardise(sample.topRows<3>());
    standardise(sample.bottomRows<3>());
  }
  return sample;
}

// `count` unit vectors with sum 0: opposite pairs and, if `count` is odd, three in a random plane.
// Uses the first (count + 1) / 2 directions.
Array3Xd balanced(const Array3Xd& directions, Eigen::Index count) {
  Array3Xd result(3, count);
  const Eigen::Index pairs = count % 2 == 0 ? count / 2 : (count - 3) / 2;
  for (Eigen::Index pair = 0; pair < pairs; ++pair) {
    result.col(2 * pair) = directions.col(pair);
    result.col(2 * pair + 1) = -directions.col(pair);
  }
  if (count % 2 == 1) {
    const Eigen::Vector3d first = directions.col(pairs);
    const Eigen::Vector3d across = first.cross(directions.col(pairs + 1).matrix());
    const Eigen::Vector3d side = across * std::sqrt(0.75 / squared(across.array()));
    result.rightCols<3>() << first, side - 0.5 * first, -0.5 * first - side;
  }
  return result;
}

Motions equal_energy_sample(const InitialCondition& condition, std::uint64_t seed) {
  const auto particles = static_cast<Eigen::Index>(condition.particle_count);
  const Eigen::Index count = condition.exact_moments ? (particles + 1) / 2 : particles;
  const CubePoints points(condition, static_cast<std::uint64_t>(count), seed);
  Motions sample(6, count);
  for (Eigen::Index number = 0; number < count; ++number) {
    const CubePoint u = points(static_cast<std::uint64_t>(number));
    sample.col(number) << direction(u[0], u[1]), direction(u[2], u[3]);
  }
  if (condition.exact_moments) {
    const Array3Xd velocities = balanced(sample.topRows<3>(), particles);
    const Array3Xd spins = balanced(sample.bottomRows<3>(), particles);
    sample.resize(6, particles);
    // Particles that share a velocity must not share a spin: v w^T would be the same for both.
    sample << velocities, spins.rightCols(particles - 1), spins.leftCols<1>();
  }
  return std::numbers::sqrt3 * sample;
}

}  // namespace

std::uint64_t hash(const Gas& gas) {
  return reflection::hash(gas);
}

std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member) {
  return member == 0 ? seed : random::draw(seed, member, 0, random::Purpose::member);
}

Gas make_gas(const InitialCondition& condition, std::uint64_t seed) {
  if (condition.particle_count < 2) {
    throw std::invalid_argument("a gas needs at least 2 particles");
  }
  if (condition.particle_count > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument("a gas has less than 2^32 particles");
  }
  if (!(condition.energy_ratio >= 0 && std::isfinite(condition.energy_ratio))) {
    throw std::invalid_argument("the ratio of energies must not be negative");
  }
  Gas gas;
  gas.motions = condition.distribution == InitialDistribution::gaussian
                    ? normal_sample(condition, seed)
                    : equal_energy_sample(condition, seed);
  gas.motions.bottomRows<3>() *= std::sqrt(kInverseInertia * condition.energy_ratio);
  return gas;
}

}  // namespace clca::boltzmann
