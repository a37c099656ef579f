#pragma once
// The connected lattice cellular automaton: one step of the priority-ordered update.

#include <array>
#include <cstdint>
#include <vector>

#include "clca/grains/model.hpp"

namespace clca::automaton {

using grains::Options;

// The choices that the paper leaves open (Sakaguchi et al. 2001, section 3).

/// Directions in which particles move by themselves: gravity and its two neighbours, or all six.
enum class CandidateDirections : std::uint8_t { downward, all };

/// Classes of moves in the update order; a move has the first of Rules::update_priority that fits.
enum class UpdateClass : std::uint8_t {
  rest,     ///< the particle rested in the step before
  inertia,  ///< the direction is that of the step before
  gravity,  ///< the direction is that of gravity
};

/// How movers of one class that want the same site are ordered: each particle by a draw of its
/// own, or all movers of one direction together, the directions by a draw per class and step.
enum class TieBreaking : std::uint8_t { particle, direction };

struct Rules {
  /// Probability to keep the direction of the previous step, in [0, 1].
  double inertia = 0.9;
  /// Probability to take any free direction, with equal chances, in [0, 1].
  double scatter = 0;
  CandidateDirections candidates = CandidateDirections::downward;
  /// Direction of gravity.
  lattice::Direction gravity = lattice::Direction::down;
  /// Each class once, in order of priority.
  std::array<UpdateClass, 3> update_priority = {UpdateClass::rest, UpdateClass::inertia,
                                                UpdateClass::gravity};
  TieBreaking ties = TieBreaking::particle;

  bool operator==(const Rules&) const = default;
};

/// Directions that the rules allow: gravity, its clockwise and other neighbour, the rest.
std::vector<lattice::Direction> candidate_directions(const Rules& rules);

/// Throws std::invalid_argument, with the reason, unless gravity is a direction and the update
/// priority names each class once. random::Probability checks probabilities.
void check_rules(const Rules& rules);

/// Bytes that steps need besides the state and its occupancy, for a lattice with this
/// index_count(). `awake`: particles that may move in a step.
double step_bytes(double index_count, double particles, double awake);

class Automaton : public grains::Model {
 public:
  /// Throws std::invalid_argument if the state (see grains::check_valid,
  /// grains::Occupancy) or the rules (see check_rules) are not valid, or the number of threads is
  /// not positive.
  explicit Automaton(grains::State state, const Rules& rules = {}, const Options& options = {});

  const grains::State& state() const { return grains(); }
  const Rules& rules() const;
};

}  // namespace clca::automaton
