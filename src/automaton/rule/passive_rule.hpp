#pragma once
// The passive rule: where a particle goes that something has been pushed onto (Sakaguchi et al.
// 2001, Fig. 8, after Murakami).

#include <optional>
#include <vector>

#include "automaton/rule/overlap_change.hpp"

namespace clca::automaton {

/// Overlaps between particles are one unit move deep at most.
inline constexpr int kDeepestOverlap = 1;

/// Judges the directions of a pushed particle. A direction has to get it out of what pushes it
/// along the way of the push, or at least sideways, without worse elsewhere; it may push others.
class PassiveRule {
 public:
  explicit PassiveRule(World& world) : world_(world) {}

  /// The best direction of a particle onto which others were pushed; kRest: it is jammed.
  grains::Move provisional(std::uint32_t id);
  /// Moves the particle that way and records whom it pushes, if that is still allowed at its turn.
  bool move(std::uint32_t id, lattice::Direction direction);

 private:
  /// How a direction gets the particle out of what pushes it.
  struct Relief {
    int turns = 0;        // by 60 degrees, from the push that is followed least
    int votes = 0;        // pushes exactly that way
    bool strict = false;  // within 60 degrees of all pushes, and each of their overlaps shrinks
  };
  /// What a direction is worth: the least score is the best.
  struct Judgement {
    std::vector<OverlapChange> changes;
    int score = 0;
  };

  std::optional<Judgement> judge(std::uint32_t id, lattice::Direction direction);
  /// None: it does not help, or makes something worse.
  std::optional<Relief> relief_of(std::uint32_t id, lattice::Direction direction,
                                  const std::vector<OverlapChange>& changes) const;
  /// Whether the direction is within 120 degrees of all pushes.
  bool follows_pushes(std::uint32_t id, lattice::Direction direction) const;
  bool has_room(std::uint32_t id, lattice::Direction direction) const;
  bool spares_walls(std::uint32_t id, lattice::Direction direction,
                    const std::vector<OverlapChange>& changes) const;
  /// Depths that grow, each weighed with the size of the other. None: one would be too deep.
  std::optional<int> grown_depth(const std::vector<OverlapChange>& changes) const;
  /// Whether the particle and those into which it would get further bear so many overlapped sites.
  bool bears(std::uint32_t id, const std::vector<OverlapChange>& changes) const;
  const lattice::Shape& shape_of(grains::Owner owner) const {
    return world_.state.shape(world_.state.particles[static_cast<std::size_t>(owner)]);
  }
  void record(std::uint32_t id, const grains::Push& cause,
              const std::vector<OverlapChange>& changes);
  grains::Push cause(std::uint32_t id, lattice::Direction direction,
                     const std::vector<OverlapChange>& changes) const;

  World& world_;
};

}  // namespace clca::automaton
