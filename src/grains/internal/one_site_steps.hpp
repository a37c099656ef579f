#pragma once
// Base of the models of grains of one site: all grains that move in a step move at once.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "grains/internal/mechanics.hpp"

namespace clca::grains {

class OneSiteMechanics : public Mechanics {
 public:
  /// Throws std::invalid_argument for invalid options, or as check_valid(), check_one_site(),
  /// Occupancy.
  OneSiteMechanics(State initial, const Options& options)
      : state_(checked_state(std::move(initial), options)), box_(state_) {
    for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
      if (state_.particles[id].previous != kRest) {
        moved_.push_back(id);
      }
    }
  }

  Box& box() override { return box_; }
  lattice::Direction down() const override { return lattice::Direction::down; }
  std::vector<std::uint32_t> moved_ids() const override { return moved_; }

 protected:
  State& state() { return state_; }
  /// Ends a step in which these particles move; all others rest. A target was free when the step
  /// began, and is that of one particle.
  void move(std::span<const std::pair<std::uint32_t, Move>> moves, StepReport& report) {
    for (const std::uint32_t id : moved_) {
      state_.particles[id].previous = kRest;
    }
    moved_.clear();
    for (const auto& [id, move] : moves) {
      Particle& particle = state_.particles[id];
      box_.occupancy.release(state_.lattice.index(particle.site()));
      particle = grains::after_step(particle, static_cast<lattice::Direction>(move));
      particle.previous = move;
      box_.occupancy.take(state_.lattice.index(particle.site()), as_owner(id));
      moved_.push_back(id);
    }
    report.moved_count = moved_.size();
    ++state_.step;
  }

 private:
  static State checked_state(State state, const Options& options) {
    check_valid(options);
    check_valid(state);
    check_one_site(state);
    return state;
  }

  State state_;
  Box box_;
  std::vector<std::uint32_t> moved_;  // in the last step
};

}  // namespace clca::grains
