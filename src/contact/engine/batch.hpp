#pragma once
// Contacts by eight. Those of a batch share no grain, so that solving them at once is the same.

#include <array>
#include <cstdint>
#include <span>

#include "clca/contact/state.hpp"
#include "contact/rule/law.hpp"

namespace clca::contact {

inline constexpr std::size_t kLanes = 8;  ///< contacts of a batch

/// Numbers of bodies: one at rest, as are all sides of the box; then walls; then grains by id.
inline constexpr std::int32_t kRestingBody = 0;
inline constexpr std::int32_t kFirstWallBody = 1;

/// Eight contacts. An empty lane is a contact of a body with itself, without any effect.
struct alignas(32) Batch {
  template <class T>
  using PerLane = std::array<T, kLanes>;

  PerLane<std::int32_t> upper = {};  ///< number of the body
  PerLane<std::int32_t> other = {};
  PerLane<std::int32_t> normal_x = {};  ///< Contact::normal
  PerLane<std::int32_t> normal_y = {};
  Impulse<PerLane<std::int32_t>> impulse = {};
  PerLane<std::int32_t> bounce_velocity = {};  ///< StepContact::bounce_velocity
  PerLane<std::int32_t> friction = {};         ///< Rule::friction_with
  PerLane<std::int32_t> pair_index = {};       ///< index in Rule::pair_coefficients
};

/// The velocity of a body, loaded and stored as 16 bytes at once.
struct alignas(16) AlignedVelocity {
  Velocity<> velocity;
};

/// An operation on all contacts of the batches, one batch after the other.
enum class Pass : std::uint8_t {
  warm_start,  ///< gives the bodies the impulses that the contacts had in the last step
  forwards,    ///< solves them from the first to the last
  backwards,   ///< solves them from the last to the first
};

/// Carries out a pass over the batches. `pairs`: Rule::pair_coefficients.
using PassFunction = void (*)(Pass pass, std::span<Batch> batches, AlignedVelocity* bodies,
                              const PairCoefficients* pairs, const LawConstants& law);
/// One contact after the other.
PassFunction plain_pass_function();
/// Eight at once by AVX2; plain_pass_function() where the compiler or the processor has none.
PassFunction fastest_pass_function();

/// A PassFunction that computes with as many contacts at once as Lanes::Int has numbers. `Lanes`
/// says how to load and store them.
template <class Lanes>
void carry_out_pass(Pass pass, std::span<Batch> batches, AlignedVelocity* bodies,
                    const PairCoefficients* pairs, const LawConstants& law) {
  using Int = typename Lanes::Int;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    Batch& batch = batches[pass == Pass::backwards ? batches.size() - 1 - i : i];
    Impulse<Batch::PerLane<std::int32_t>>& impulses = batch.impulse;
    for (std::size_t lane = 0; lane < kLanes; lane += Lanes::kWidth) {
      Impulse<Int> impulse = {Lanes::load(&impulses.normal[lane]),
                              Lanes::load(&impulses.shear[lane]),
                              Lanes::load(&impulses.rolling[lane])};
      ContactBodies<Int> both = {
          .upper = Lanes::velocities(bodies, &batch.upper[lane]),
          .other = Lanes::velocities(bodies, &batch.other[lane]),
          .normal_x = Lanes::load(&batch.normal_x[lane]),
          .normal_y = Lanes::load(&batch.normal_y[lane]),
          .coefficients = Lanes::coefficients(pairs, &batch.pair_index[lane])};
      if (pass == Pass::warm_start) {
        apply_impulse(both, impulse, law.rotates);
      } else {
        solve_contact(impulse, both, Lanes::load(&batch.bounce_velocity[lane]),
                      Lanes::load(&batch.friction[lane]), law);
        Lanes::store(impulse.normal, &impulses.normal[lane]);
        Lanes::store(impulse.shear, &impulses.shear[lane]);
        Lanes::store(impulse.rolling, &impulses.rolling[lane]);
      }
      Lanes::set_velocities(bodies, &batch.upper[lane], both.upper);
      Lanes::set_velocities(bodies, &batch.other[lane], both.other);
    }
  }
}

}  // namespace clca::contact
