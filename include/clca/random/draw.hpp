#pragma once
// Counter-based random draws: every draw is a pure function of its arguments.

#include <cstdint>

namespace clca::random {

/// The decision that a draw is for. Draws of one particle in one step differ by purpose.
enum class Purpose : std::uint32_t {
  // Draws of the models of grains.
  scatter = 1,          ///< whether a particle takes any free direction
  inertia = 2,          ///< whether it keeps its direction
  coin = 3,             ///< which of two directions at one angle to gravity
  tie = 4,              ///< order of movers of one class
  direction_order = 5,  ///< order of two directions at one angle to gravity; contact model, too
  fill_position = 6,
  source_species = 8,
  source_position = 9,
  scatter_direction = 10,  ///< which free direction
  passive = 11,            ///< among equal directions of a particle that was pushed or has pushed
  deposit_species = 12,
  deposit_kind = 13,  ///< orientation
  deposit_column = 14,
  deposit_coin = 15,      ///< down to the left or to the right
  source_remainder = 16,  ///< of the contact model
  void_choice = 17,       ///< which grain a void claims
  void_coin = 18,         ///< which of two voids gets a grain
  weight_pair = 19,       ///< which two supports carry a grain, measure::weight_paths
  weight_share = 20,      ///< share of a support in a weight, likewise
  equal_energy = 21,      ///< of the Baxter model: among choices of equal energy
  contested_site = 22,    ///< of the Baxter model: who gets it
  // Draws of the Boltzmann equation.
  member = 32,  ///< seed of a member of an ensemble
  initial_velocity = 33,
  initial_spin = 34,
  regroup = 35,         ///< which particles meet in a step
  candidate = 36,       ///< pairs that may collide
  normal = 37,          ///< second of a pair, and line of centres
  partner = 38,         ///< of the scheme of Ogawa & Kato
  lattice_shift = 39,   ///< of a lattice rule
  last_candidate = 40,  ///< whether a fraction of a candidate becomes one
};

/// 64 uniform bits from Philox4x32-10 (Salmon et al. 2011): key = seed, counter = the rest.
/// `item` is a particle id, or another number that the purpose defines.
std::uint64_t draw(std::uint64_t seed, std::uint64_t step, std::uint32_t item, Purpose purpose);

/// Maps 64 uniform bits to 0, 1, ..., `count` - 1. Precondition (not checked): `count` is positive.
std::uint64_t uniform_below(std::uint64_t bits, std::uint64_t count);

/// A probability as an integer threshold, so that no floating point decides a move.
class Probability {
 public:
  /// Rounds `value` to a multiple of 2^-53 or finer. Throws std::invalid_argument outside [0, 1].
  explicit Probability(double value);

  /// True with this probability for uniform `bits`.
  bool accepts(std::uint64_t bits) const { return (bits >> 1U) < threshold_; }
  bool is_zero() const { return threshold_ == 0; }
  bool operator==(const Probability&) const = default;

 private:
  std::uint64_t threshold_ = 0;  // of 2^63
};

}  // namespace clca::random
