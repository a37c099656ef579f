#pragma once
// The passive rule: where a particle goes that something has been pushed onto (Sakaguchi et al.
// 2001, Fig. 8, after Murakami).

#include <optional>
#include <vector>

#include "automaton/rule/overlap_change.hpp"

namespace clca::automaton {

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
  /// How a direction follows the pushes: strictly, or else relaxed.
  struct Following {
    int turns = 0;         // by 60 degrees, from the push that is followed least
    int pushes_along = 0;  // pushes exactly in the direction
    bool strict = false;   // within 60 degrees of all pushes, and each of their overlaps shrinks
  };
  /// What a direction is worth: the least score is the best.
  struct Judgement {
    std::vector<OverlapChange> changes;
    int score = 0;
  };

  std::optional<Judgement> judge(std::uint32_t id, lattice::Direction direction);
  /// None: neither strict nor relaxed.
  std::optional<Following> following_of(std::uint32_t id, lattice::Direction direction,
                                        const std::vector<OverlapChange>& changes) const;
  /// Whether the direction is within 120 degrees of all pushes.
  bool follows_pushes(std::uint32_t id, lattice::Direction direction) const;
  bool has_room(std::uint32_t id, lattice::Direction direction) const;
  /// Whether the move gets onto no further wall, and shares no more sites with walls than now.
  bool keeps_off_walls(std::uint32_t id, lattice::Direction direction,
                       const std::vector<OverlapChange>& changes) const;
  /// Overlaps that begin, each weighed with the size of the other. None: one would be too deep.
  std::optional<int> grown_depth(std::uint32_t id, lattice::Direction direction,
                                 const std::vector<OverlapChange>& changes) const;
  /// Whether the particle, and each of those into which it would get further, shares no more sites
  /// than its limit.
  bool is_within_limits(std::uint32_t id, const std::vector<OverlapChange>& changes) const;
  const lattice::Shape& shape_of(grains::Owner owner) const {
    return world_.state.shape(world_.state.particles[grains::particle_id(owner)]);
  }
  void record(std::uint32_t id, const grains::Push& cause,
              const std::vector<OverlapChange>& changes);
  grains::Push cause(std::uint32_t id, lattice::Direction direction,
                     const std::vector<OverlapChange>& changes) const;

  World& world_;
};

}  // namespace clca::automaton
