#pragma once
// The particles of one group in one step, and the collisions among them.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "boltzmann/collisions.hpp"
#include "clca/boltzmann/law.hpp"
#include "random/words.hpp"

namespace clca::boltzmann {

/// Says which draws a group makes in a step: they are a pure function of it.
struct GroupKey {
  std::uint64_t seed = 0;
  std::uint32_t step = 0;
  std::uint32_t group = 0;
};

/// Pairs in continuous time. With s the speeds of M particles and s_max the greatest, candidates
/// (i, j) come at the rate M s_max: i is any particle and goes on with s_i / s_max, j is any other,
/// and the two collide with |v_i - v_j| / (s_i + s_j), which cannot exceed 1. So each pair collides
/// at the rate |v_i - v_j| / (M - 1). The clock counts candidates, each for its mean waiting time:
/// drawing the times would add noise and nothing else.
///
/// Candidates are decided many at a time, as if each saw what those before it have done: where two
/// of them share a particle, or a speed passes s_max, they are decided again one by one.
class Group {
 public:
  /// Makes room for particles, to be set one by one; two at least.
  void resize(Eigen::Index particles);
  Eigen::Index particles() const { return speeds_.size(); }
  /// Velocity and spin of a particle.
  auto motion(Eigen::Index particle) { return motions_.col(particle).head<6>(); }

  /// Collisions during `duration` (time unit of gas.hpp); returns how many.
  std::uint64_t collide(const Law& law, const GroupKey& key, double duration);

 private:
  static constexpr std::size_t kBatch = 32;  // candidates
  static constexpr std::size_t kLanes = 8;   // collisions that are computed at once

  /// One of a batch.
  struct Candidate {
    std::uint32_t first = 0;
    std::uint32_t chance = 0;  // of the first to go on, of 2^32
    std::uint32_t second = 0;
    random::Words words = {};  // which second, its chance, line of centres
  };
  /// Some of a batch, by number.
  struct Selection {
    std::array<std::uint8_t, kBatch> numbers = {};
    std::size_t count = 0;

    void push(std::size_t number, bool stays) {  // no branch
      numbers[count] = static_cast<std::uint8_t>(number);
      count += stays ? 1 : 0;
    }
    const std::uint8_t* begin() const { return numbers.data(); }
    const std::uint8_t* end() const { return numbers.data() + count; }
  };

  void measure_speeds();
  void draw_firsts(const GroupKey& key, std::uint32_t batch, std::size_t count);
  void draw_second(const GroupKey& key, std::uint32_t batch, std::size_t number);
  bool goes_on(const Candidate& candidate) const;
  bool meets(const Candidate& candidate) const;

  /// Decides all candidates of a batch, or none and says false.
  bool decide_at_once(const Law& law, const GroupKey& key, std::uint32_t batch);
  /// Decides them until a speed passes s_max; returns how many.
  std::size_t decide_one_by_one(const Law& law, const GroupKey& key, std::uint32_t batch);
  /// Whether a particle of a pair is that of another candidate, too.
  bool share_particles();

  template <int kWidth>
  void load(Collisions<kWidth>& collisions, int lane, const Candidate& pair) const;
  template <int kWidth>
  void store(const Collisions<kWidth>& collisions, int lane, const Candidate& pair);
  bool collide_at_once(const Law& law);

  Eigen::Array<double, 8, Eigen::Dynamic> motions_;  // velocity, spin, 2 unused: a cache line each
  Eigen::ArrayXd speeds_;
  double fastest_ = 0;
  std::uint64_t collisions_ = 0;
  // The batch at hand: its candidates, those that go on, and those that collide.
  std::array<Candidate, kBatch> candidates_;
  std::size_t count_ = 0;
  Selection seconds_;
  Selection pairs_;
  std::array<Collisions<kLanes>, kBatch / kLanes> chunks_;
  std::vector<std::uint8_t> touched_;  // by a pair; all 0 between batches
};

}  // namespace clca::boltzmann
