#pragma once
// Which grain a void claims, and which of these voids the grain goes to.

#include <array>
#include <vector>

#include "clca/voids/void_model.hpp"
#include "grains/internal/box.hpp"

namespace clca::voids {

/// From a grain to the voids that may claim it: straight down first.
inline constexpr std::array<lattice::Direction, 3> kDownward = {
    lattice::Direction::down, lattice::Direction::down_left, lattice::Direction::down_right};

/// Pure: a decision depends on the occupancy as it is and the draws of its void or grain and step.
class Rule {
 public:
  Rule(const grains::Box& box, const Rules& rules);

  /// The grain that the void at this site claims: one of the three above it, in proportion to their
  /// weights. kFree if they have none.
  grains::Owner claimed(lattice::Site site) const;
  /// Where a grain goes that these of kDownward claim: straight down first; a coin decides between
  /// the others.
  grains::Move granted(std::uint32_t id, const std::array<bool, 3>& claims) const;

 private:
  const grains::Box& box_;
  std::vector<std::array<std::uint64_t, 3>> weights_;  // by kind and kDownward
};

}  // namespace clca::voids
