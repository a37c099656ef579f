#include "boltzmann/engine/group.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clca/boltzmann/gas.hpp"

namespace clca::boltzmann::group_test {
namespace {

constexpr Law kLaw = {.restitution = 0.5, .friction = 0.3, .roughness = 0};

/// Normal velocities and spins, good enough for a test.
Motions some_motions(Eigen::Index particles, std::uint64_t seed) {
  Motions motions(6, particles);
  for (Eigen::Index i = 0; i < particles; ++i) {
    for (std::uint32_t k = 0; k < 6; ++k) {
      const random::Words words = random::drawn_words(seed, {7, k, static_cast<std::uint32_t>(i)},
                                                      random::Purpose::initial_velocity);
      motions(k, i) = open_uniform32(words[0]) + open_uniform32(words[1]) +
                      open_uniform32(words[2]) + open_uniform32(words[3]) - 2;
    }
  }
  return motions;
}

Motions motions_of(Group& group) {
  Motions motions(6, group.particle_count());
  for (Eigen::Index i = 0; i < group.particle_count(); ++i) {
    motions.col(i) = group.motion(i);
  }
  return motions;
}

void load(Group& group, const Motions& motions) {
  group.resize(motions.cols());
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    group.motion(i) = motions.col(i);
  }
}

/// What Group says it does, one candidate after the other, in the plainest form.
class Oracle {
 public:
  explicit Oracle(Motions motions) : motions_(std::move(motions)) {}

  std::uint64_t collide(const Law& law, const GroupKey& key, double duration) {
    constexpr std::uint32_t kBatch = 32;
    const auto size = static_cast<double>(motions_.cols());
    const double share = open_uniform32(random::drawn_words(key.seed, {key.step, key.group, 0},
                                                            random::Purpose::last_candidate)[0]);
    double fastest = measured();
    std::uint64_t collisions = 0;
    std::size_t since = 0;
    double left = duration;
    for (std::uint32_t batch = 0;; ++batch) {
      const double waiting = 1 / (size * fastest);
      const double candidates = std::floor(left / waiting + share);
      if (candidates < 1) {
        return collisions;
      }
      const auto count = static_cast<std::uint32_t>(std::min<double>(candidates, kBatch));
      std::uint32_t decided = 0;
      bool passed = false;
      while (decided < count && !passed) {
        const bool hit = candidate(law, key, batch * kBatch + decided, fastest);
        ++decided;
        collisions += hit ? 1 : 0;
        passed = hit && std::max(speed(first_), speed(second_)) > fastest;
      }
      left -= decided * waiting;
      since += decided;
      if (decided < count || since >= static_cast<std::size_t>(motions_.cols())) {
        fastest = measured();
        since = 0;
      }
    }
  }
  const Motions& motions() const { return motions_; }

 private:
  double speed(Eigen::Index i) const {
    return std::sqrt(motions_(0, i) * motions_(0, i) + motions_(1, i) * motions_(1, i) +
                     motions_(2, i) * motions_(2, i));
  }
  double measured() const {
    double most = 0;
    for (Eigen::Index i = 0; i < motions_.cols(); ++i) {
      most = std::max(most, speed(i));
    }
    return most;
  }

  /// True when it ends in a collision.
  bool candidate(const Law& law, const GroupKey& key, std::uint32_t item, double fastest) {
    const auto size = static_cast<std::uint64_t>(motions_.cols());
    const std::uint64_t product = random::drawn_words(key.seed, {key.step, key.group, item / 4},
                                                      random::Purpose::candidate)[item % 4] *
                                  size;
    first_ = static_cast<Eigen::Index>(product >> 32U);
    if (open_uniform32(static_cast<std::uint32_t>(product)) * fastest >= speed(first_)) {
      return false;
    }
    const random::Words words =
        random::drawn_words(key.seed, {key.step, key.group, item}, random::Purpose::normal);
    second_ = static_cast<Eigen::Index>((words[0] * (size - 1)) >> 32U);
    second_ += second_ >= first_ ? 1 : 0;
    const auto motion = [this](Eigen::Index i) { return motions_.col(i).transpose(); };
    const Vectors<1> g = motion(first_).head<3>() - motion(second_).head<3>();
    const double bound = open_uniform32(words[1]) * (speed(first_) + speed(second_));
    if (bound * bound >= dot(g, g).value()) {
      return false;
    }
    const Vectors<1> spins = motion(first_).tail<3>() + motion(second_).tail<3>();
    const ImpulsePair<1> exchange =
        solid_collision<1>(law, g, spins,
                           line_of_centres<1>(g, Lanes<1>(open_uniform32(words[2])),
                                              Lanes<1>(open_uniform32(words[3]))));
    const Eigen::Array3d impulse = exchange.impulse.transpose();
    const Eigen::Array3d angular_impulse = exchange.angular_impulse.transpose();
    motions_.col(first_).head<3>() -= impulse;
    motions_.col(second_).head<3>() += impulse;
    motions_.col(first_).tail<3>() -= kInverseInertia * angular_impulse;
    motions_.col(second_).tail<3>() -= kInverseInertia * angular_impulse;
    return true;
  }

  Motions motions_;
  Eigen::Index first_ = 0;
  Eigen::Index second_ = 0;
};

TEST(Group, DecidesManyAtOnceAsIfOneByOneToTheBit) {
  for (const Eigen::Index particles : {2, 3, 10, 33, 100, 1000, 5000}) {
    for (std::uint32_t step = 0; step < 4; ++step) {
      const Motions motions = some_motions(particles, step);
      const GroupKey key = {.seed = 11, .step = step, .group = 2};
      Group group;
      load(group, motions);
      Oracle oracle(motions);
      const std::uint64_t collisions = group.collide(kLaw, key, 2);
      EXPECT_EQ(collisions, oracle.collide(kLaw, key, 2)) << particles;
      EXPECT_TRUE((motions_of(group) == oracle.motions()).all()) << particles;
      EXPECT_GT(collisions, 0U);
    }
  }
}

TEST(Group, KeepsMomentumToRoundingAndLosesEnergy) {
  const Motions motions = some_motions(2000, 1);
  Group group;
  load(group, motions);
  group.collide(kLaw, {.seed = 1, .step = 0, .group = 0}, 3);
  const Motions after = motions_of(group);
  EXPECT_LT(
      (after.topRows(3).rowwise().sum() - motions.topRows(3).rowwise().sum()).abs().maxCoeff(),
      1e-10);
  const auto energy = [](const Motions& all) {
    return all.topRows(3).square().sum() + all.bottomRows(3).square().sum() / kInverseInertia;
  };
  EXPECT_LT(energy(after), 0.8 * energy(motions));
}

TEST(Group, AtRestStaysAtRest) {
  Group group;
  load(group, Motions::Zero(6, 100));
  EXPECT_EQ(group.collide(kLaw, {}, 1e6), 0U);
}

TEST(Group, OneFastParticleAmongRestingOnesStopsInTime) {
  Motions motions = Motions::Zero(6, 100);
  motions(0, 17) = 1e3;
  Group group;
  load(group, motions);
  EXPECT_GT(group.collide(kLaw, {.seed = 3, .step = 0, .group = 0}, 0.1), 10U);
  EXPECT_LT(motions_of(group).abs().maxCoeff(), 1e3);
}

}  // namespace
}  // namespace clca::boltzmann::group_test
