#pragma once
// What models of grains of one site have in common: all grains that move in a step move at once.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "grains/internal/mechanics.hpp"

namespace clca::grains {

class OneSiteSteps : public Mechanics {
 public:
  /// Throws std::invalid_argument if the state (see check_valid(), check_one_site(), Occupancy) or
  /// the options are not valid.
  OneSiteSteps(State initial, const Options& options);

  Box& box() override { return box_; }
  lattice::Direction down() const override { return lattice::Direction::down; }
  std::vector<std::uint32_t> moved() const override { return moved_; }

 protected:
  State& state() { return state_; }
  /// Ends a step in which these particles move; all others rest. A target was free when the step
  /// began, and is that of one particle.
  void move(std::span<const std::pair<std::uint32_t, Move>> moves, StepReport& report);

 private:
  State state_;
  Box box_;
  std::vector<std::uint32_t> moved_;  // in the last step
};

}  // namespace clca::grains
