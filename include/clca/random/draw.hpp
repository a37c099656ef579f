#pragma once
// Counter-based random draws: every draw is a pure function of its arguments.

#include <cstdint>

namespace clca::random {

/// What a draw decides. Draws of one particle in one step differ by purpose.
enum class Purpose : std::uint32_t {
  scatter = 1,
  inertia = 2,
  coin = 3,
  tie = 4,
  direction_order = 5,
  fill_position = 6,
  source_species = 8,
  source_position = 9,
  scatter_direction = 10,
  passive = 11,
  deposit_species = 12,
  deposit_kind = 13,
  deposit_column = 14,
  deposit_coin = 15,
  source_remainder = 16,
  void_choice = 17,
  void_coin = 18,
  weight_pair = 19,
  weight_share = 20,
  equal_energy = 21,
  contested_site = 22,
  // For the Boltzmann equation.
  member = 32,  ///< seed of a member of an ensemble
  initial_velocity = 33,
  initial_spin = 34,
  regroup = 35,    ///< which particles meet in a step
  candidate = 36,  ///< pairs that may collide
  normal = 37,     ///< second of a pair, and line of centres
  partner = 38,    ///< of the scheme of Ogawa & Kato
  lattice_shift = 39,
  last_candidate = 40,
};

/// 64 uniform bits from Philox4x32-10 (Salmon et al. 2011): key = seed, counter = the rest.
/// `item` is a particle id, or another number that the purpose defines.
std::uint64_t draw(std::uint64_t seed, std::uint64_t step, std::uint32_t item, Purpose purpose);

/// Maps 64 uniform bits to 0, 1, ..., `count` - 1. Precondition (not checked): `count` is positive.
std::uint64_t below(std::uint64_t bits, std::uint64_t count);

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
