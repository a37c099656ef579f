#pragma once
// Groups of particles that collide among themselves in a step, independent of each other.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace clca::boltzmann {

/// A random permutation of 0 to count - 1: multiples of a random stride modulo the smallest prime
/// >= `count`, from a random start.
/// Any two numbers are equally likely to be any distance apart. Computed on the fly, not stored.
class StridedPermutation {
 public:
  explicit StridedPermutation(std::uint64_t count);

  void shuffle(std::uint64_t start_bits, std::uint64_t stride_bits);
  /// Calls `visit` for the numbers of part `part` of `parts` equal parts of the permutation.
  template <class Visit>
  void visit_part(std::uint64_t part, std::uint64_t parts, Visit visit) const {
    const std::uint64_t end = modulus_ * (part + 1) / parts;
    std::uint64_t position = modulus_ * part / parts;
    std::uint64_t number = (start_ + stride_ * position) % modulus_;
    for (; position < end; ++position) {
      if (number < count_) {
        visit(number);
      }
      number += stride_;
      number -= number >= modulus_ ? modulus_ : 0;
    }
  }

 private:
  std::uint64_t count_;
  std::uint64_t modulus_;
  std::uint64_t start_ = 0;
  std::uint64_t stride_ = 1;
};

/// Blocks of neighbouring particles in an order drawn anew in each step, cut into groups.
/// Within a group the particles are permuted in each step, so that neighbours do not stay together.
class Grouping {
 public:
  /// Particles per block.
  static constexpr Eigen::Index kBlockSize = 32;

  /// Groups of about `group_size` particles.
  Grouping(Eigen::Index particles, Eigen::Index group_size);

  Eigen::Index group_count() const { return groups_; }
  /// The groups of a step depend on seed and step only.
  void shuffle(std::uint64_t seed, std::uint64_t step);
  /// Positions of the particles of a group now (`sources`) and after the step (`targets`).
  void members(Eigen::Index group, std::vector<Eigen::Index>& sources,
               std::vector<Eigen::Index>& targets) const;

 private:
  Eigen::Index particles_;
  Eigen::Index groups_;
  StridedPermutation block_order_;
  std::uint64_t seed_ = 0;
  std::uint64_t step_ = 0;
};

}  // namespace clca::boltzmann
