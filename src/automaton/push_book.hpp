#pragma once
// The pushes of a state in order, and who takes part in one.

#include <span>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// Every pair that overlaps has one push in State::pushes, and there are no others.
class PushBook {
 public:
  explicit PushBook(const State& state);

  /// True when the particle overlaps with something.
  bool engaged(std::uint32_t id) const { return parts_[id] > 0; }
  /// All engaged particles, ascending.
  static std::vector<std::uint32_t> engaged_particles(const State& state);
  /// The pushes onto `id`.
  static std::span<const Push> onto(const State& state, std::uint32_t id);
  /// The push by which `pusher` came onto `id`; null where there is none.
  static const Push* find(const State& state, std::uint32_t id, Owner pusher);

  void grow(std::size_t particles) { parts_.resize(particles, 0); }
  /// Enters a push, or renews the one of the same pair.
  void record(State& state, const Push& push);
  /// Forgets the push between the particle and `other`, whoever pushed.
  void forget(State& state, std::uint32_t id, Owner other);

 private:
  void count(const Push& push, int change);
  bool erase(State& state, std::uint32_t pushed, Owner pusher);

  std::vector<std::uint32_t> parts_;  // pushes in which a particle takes part, by id
};

}  // namespace clca::automaton
