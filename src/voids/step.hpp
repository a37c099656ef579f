#pragma once
// One step of the void model, as docs/voids.md has it.

#include <cstdint>
#include <vector>

#include "grains/internal/mechanics.hpp"
#include "voids/rule.hpp"

namespace clca::voids {

class Steps final : public grains::Mechanics {
 public:
  Steps(grains::State initial, const Rules& rules);

  grains::Box& box() override { return box_; }
  lattice::Direction down() const override { return lattice::Direction::down; }
  bool advance(grains::StepReport& report) override;
  std::vector<std::uint32_t> moved() const override { return moved_; }
  // Nothing is known of a grain but its state.
  void added(std::size_t first) override { static_cast<void>(first); }
  void removing(std::uint32_t id) override { static_cast<void>(id); }
  void reloaded() override {}

 private:
  /// By id: which of the voids of kDownward claim the grain.
  std::vector<std::array<bool, kDownward.size()>> claims() const;

  grains::State state_;
  grains::Box box_;
  Rule rule_;
  std::vector<std::uint32_t> moved_;  // in the last step
};

}  // namespace clca::voids
