#pragma once
// The pushes of a state in order, and who takes part in one.

#include <span>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::automaton {

/// Every pair that overlaps has one push in State::pushes, and there are no others.
class PushList {
 public:
  explicit PushList(const grains::State& state);

  /// True when the particle overlaps with something.
  bool overlapping(std::uint32_t id) const { return parts_[id] > 0; }
  /// All overlapping particles, ascending.
  static std::vector<std::uint32_t> overlapping_particles(const grains::State& state);
  /// The pushes onto `id`.
  static std::span<const grains::Push> onto(const grains::State& state, std::uint32_t id);

  void resize(std::size_t particles) { parts_.resize(particles, 0); }
  /// Enters a push, or renews the one of the same pair.
  void record(grains::State& state, const grains::Push& push);
  /// Forgets the push between the particle and `other`, whoever pushed.
  void forget(grains::State& state, std::uint32_t id, grains::Owner other);

 private:
  void count(const grains::Push& push, int change);
  bool erase(grains::State& state, std::uint32_t pushed, grains::Owner pusher);

  std::vector<std::uint32_t> parts_;  // pushes in which a particle takes part, by id
};

}  // namespace clca::automaton
