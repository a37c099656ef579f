#pragma once
// One step of the Baxter model, as docs/baxter.md has it.

#include <cstdint>
#include <vector>

#include "baxter/rule.hpp"
#include "grains/internal/mechanics.hpp"

namespace clca::baxter {

class Steps final : public grains::Mechanics {
 public:
  Steps(grains::State initial, const Rules& rules);

  grains::Box& box() override { return box_; }
  lattice::Direction down() const override { return lattice::Direction::down; }
  void added(std::size_t first) override { static_cast<void>(first); }
  bool advance(grains::StepReport& report) override;
  std::vector<std::uint32_t> moved() const override { return moved_; }
  void removing(std::uint32_t id) override { static_cast<void>(id); }
  void reloaded() override {}

 private:
  grains::State state_;
  grains::Box box_;
  Rule rule_;
  std::vector<std::uint32_t> moved_;  // in the last step
};

}  // namespace clca::baxter
