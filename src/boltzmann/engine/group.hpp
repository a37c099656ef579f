#pragma once
// The particles of one group in one step, and the collisions among them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "boltzmann/rule/solid_collision.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/random/words.hpp"

namespace clca::boltzmann {

/// Key of the draws of a group in a step.
struct GroupKey {
  std::uint64_t seed = 0;
  std::uint32_t step = 0;
  std::uint32_t group = 0;
};

/// Candidate pairs (i, j) of M particles come at the rate M s_max, s_max being the largest speed: i
/// is any particle, accepted with s_i / s_max, j any other. They collide with probability |v_i -
/// v_j| / (s_i + s_j) <= 1, so every pair collides at the rate |v_i - v_j| / (M - 1). The clock
/// adds the mean waiting time per candidate: random waiting times would only add noise. Candidates
/// are decided in batches. If two of a batch share a particle, or a speed exceeds s_max, the batch
/// is decided one by one.
class Group {
 public:
  /// Allocates at least two particles, to be set one by one.
  void resize(Eigen::Index particles);
  Eigen::Index particle_count() const { return speeds_.size(); }
  /// Velocity and spin of a particle.
  auto motion(Eigen::Index particle) { return motions_.col(particle).head<6>(); }

  /// Collisions during `duration` (time unit of gas.hpp); returns how many.
  std::uint64_t collide(const Law& law, const GroupKey& key, double duration);

 private:
  static constexpr std::size_t kBatch = 32;  // candidates
  static constexpr std::size_t kLanes = 8;   // collisions that are computed at once

  /// A candidate pair of a batch.
  struct Candidate {
    std::uint32_t first = 0;
    std::uint32_t chance = 0;  // acceptance draw of the first, in units of 2^-32
    std::uint32_t second = 0;
    random::Words words = {};  // second particle, acceptance draw, line of centres
  };
  /// Selected candidates of a batch, by number.
  struct Selection {
    std::array<std::uint8_t, kBatch> numbers = {};
    std::size_t count = 0;

    void append(std::size_t number, bool stays) {  // no branch
      numbers[count] = static_cast<std::uint8_t>(number);
      count += stays ? 1 : 0;
    }
    const std::uint8_t* begin() const { return numbers.data(); }
    const std::uint8_t* end() const { return numbers.data() + count; }
  };

  void measure_speeds();
  void draw_firsts(const GroupKey& key, std::uint32_t batch, std::size_t count);
  void draw_second(const GroupKey& key, std::uint32_t batch, std::size_t number);
  bool passes_speed_test(const Candidate& candidate) const;
  bool collides(const Candidate& candidate) const;

  /// Decides all candidates of a batch; returns false without change if they are not independent.
  bool decide_at_once(const Law& law, const GroupKey& key, std::uint32_t batch);
  /// Decides candidates in order until a speed exceeds s_max; returns how many.
  std::size_t decide_one_by_one(const Law& law, const GroupKey& key, std::uint32_t batch);
  /// Whether candidates depend on each other: a pair that collides shares a particle with another.
  bool pairs_share_particle();

  template <int kWidth>
  void load(Collisions<kWidth>& collisions, int lane, const Candidate& pair) const;
  template <int kWidth>
  void store(const Collisions<kWidth>& collisions, int lane, const Candidate& pair);
  /// Collides all pairs; returns false and changes nothing if a speed exceeds s_max.
  bool collide_at_once(const Law& law);

  Eigen::Array<double, 8, Eigen::Dynamic> motions_;  // velocity, spin, 2 unused: a cache line each
  Eigen::ArrayXd speeds_;                            // by particle
  double fastest_ = 0;                               // s_max
  std::uint64_t collisions_ = 0;
  // The current batch: its candidates, those whose first particle is accepted, and who collide.
  std::array<Candidate, kBatch> candidates_;
  std::size_t candidate_count_ = 0;
  Selection accepted_;
  Selection colliding_;
  std::array<Collisions<kLanes>, kBatch / kLanes> chunks_;
  std::vector<std::uint8_t> touched_;  // 1 for particles of a pair; all 0 between batches
};

}  // namespace clca::boltzmann
