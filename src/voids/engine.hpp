#pragma once
// The void model, faster: only grains above a free site are examined, on several threads.

#include "clca/parallel/split.hpp"
#include "voids/step.hpp"

namespace clca::voids {

/// Comes to the same states as Reference: a void has a grain to claim only if a grain above it is
/// examined, and what it claims does not depend on who asks.
class Engine final : public Steps {
 public:
  Engine(grains::State initial, const Rules& rules, const Options& options);

 private:
  void added(std::size_t first) override { wake_from(first); }
  void reloaded() override { wake_from(0); }
  std::vector<GrainMove> granted_moves() override;
  void vacated(lattice::Site site) override;

  bool can_move(const grains::Particle& grain) const;
  grains::Move granted_move(std::uint32_t id) const;
  void wake(std::uint32_t id);
  void wake_from(std::size_t first);

  parallel::Threads threads_;
  parallel::PartLists<GrainMove> found_;
  std::vector<std::uint32_t> awake_;  // each once; all that may be above a free site
  std::vector<bool> is_awake_;
};

}  // namespace clca::voids
