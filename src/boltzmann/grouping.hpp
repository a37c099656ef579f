#pragma once
// Who meets whom in a step: the particles in groups that can be worked on one beside the other.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace clca::boltzmann {

/// 0 to count - 1, each once, with one stride modulo the least prime that is not smaller than
/// `count`; start and stride come from 2 x 64 uniform bits. Over these, any two numbers are as far
/// apart as any other two. Not stored, but reckoned where it is needed.
class Walk {
 public:
  explicit Walk(std::uint64_t count);

  void shuffle(std::uint64_t bits, std::uint64_t more_bits);
  /// Calls `visit` with the numbers at places from `part` / `parts` of the walk to the next such.
  template <class Visit>
  void part(std::uint64_t part, std::uint64_t parts, Visit visit) const {
    const std::uint64_t end = modulus_ * (part + 1) / parts;
    std::uint64_t place = modulus_ * part / parts;
    std::uint64_t number = (start_ + stride_ * place) % modulus_;
    for (; place < end; ++place) {
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

/// All particles in runs of a few neighbours, the runs along a walk drawn anew in each step, and
/// the walk cut into groups. Within a group the particles change places in each step, so that
/// neighbours do not stay together.
class Grouping {
 public:
  /// Particles of a run.
  static constexpr Eigen::Index kRun = 32;

  /// Groups of about `group_size` particles.
  Grouping(Eigen::Index particles, Eigen::Index group_size);

  Eigen::Index groups() const { return groups_; }
  /// Those of a step are a function of seed and step.
  void shuffle(std::uint64_t seed, std::uint64_t step);
  /// The particles of a group as they lie, and where each is to lie after the step.
  void members(Eigen::Index group, std::vector<Eigen::Index>& now,
               std::vector<Eigen::Index>& then) const;

 private:
  Eigen::Index particles_;
  Eigen::Index groups_;
  Walk runs_;
  std::uint64_t seed_ = 0;
  std::uint64_t step_ = 0;
};

}  // namespace clca::boltzmann
