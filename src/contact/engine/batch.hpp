#pragma once
// Contacts by eight: those of a batch share no grain, so that they can be solved at once with the
// result of one after the other.

#include <array>
#include <cstdint>

#include "clca/contact/state.hpp"
#include "contact/rule/law.hpp"

namespace clca::contact {

inline constexpr std::size_t kLanes = 8;

/// Numbers of bodies: one at rest, as are all sides of the box; then walls; then grains by id.
inline constexpr std::int32_t kRestingBody = 0;
inline constexpr std::int32_t kFirstWallBody = 1;

/// Eight contacts. An empty lane is a contact of a body with itself, without any effect.
struct alignas(32) Batch {
  template <class T>
  using PerLane = std::array<T, kLanes>;

  PerLane<std::int32_t> upper = {};  ///< body
  PerLane<std::int32_t> other = {};
  PerLane<std::int32_t> normal_x = {};
  PerLane<std::int32_t> normal_y = {};
  Impulse<PerLane<std::int32_t>> impulse = {};
  PerLane<std::int32_t> bounce = {};
  PerLane<std::int32_t> friction = {};
  PerLane<std::int32_t> pair = {};  ///< PairCoefficients::pair_number
};

/// The velocity of a grain where it is loaded and stored at once.
struct alignas(16) BodyVelocity {
  Velocity<> velocity;
};

/// How batches are carried out. `pairs`: PairCoefficients::pairs().
struct BatchFunctions {
  /// Gives the bodies the impulses that the contacts remember.
  void (*apply)(const Batch* batches, std::size_t count, BodyVelocity* bodies, const Pair* pairs,
                bool rotates);
  /// Solves all contacts, forwards or backwards.
  void (*sweep)(Batch* batches, std::size_t count, BodyVelocity* bodies, const Pair* pairs,
                const LawConstants& law, bool backwards);
};
/// One contact after the other.
BatchFunctions plain_functions();
/// Eight at once by AVX2; plain_functions() where the compiler or the processor has none.
BatchFunctions fastest_functions();

/// A batch by numbers of some width: contacts from `lane` on, as many as Lanes::Int has numbers.
/// `Lanes` says how to load and store them.
template <class Lanes>
class BatchKernel {
 public:
  using Int = typename Lanes::Int;

  static void apply(const Batch* batches, std::size_t count, BodyVelocity* bodies,
                    const Pair* pairs, bool rotates) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t lane = 0; lane < kLanes; lane += Lanes::kWidth) {
        BatchKernel kernel(batches[i], lane, bodies, pairs);
        contact::apply(kernel.touching_, kernel.impulse_, rotates);
        kernel.store_velocities(batches[i]);
      }
    }
  }

  static void sweep(Batch* batches, std::size_t count, BodyVelocity* bodies, const Pair* pairs,
                    const LawConstants& law, bool backwards) {
    for (std::size_t i = 0; i < count; ++i) {
      Batch& batch = batches[backwards ? count - 1 - i : i];
      for (std::size_t lane = 0; lane < kLanes; lane += Lanes::kWidth) {
        BatchKernel kernel(batch, lane, bodies, pairs);
        solve(kernel.impulse_, kernel.touching_, kernel.load(batch.bounce),
              kernel.load(batch.friction), law);
        kernel.store_velocities(batch);
        kernel.store(kernel.impulse_.normal, batch.impulse.normal);
        kernel.store(kernel.impulse_.shear, batch.impulse.shear);
        kernel.store(kernel.impulse_.rolling, batch.impulse.rolling);
      }
    }
  }

 private:
  [[gnu::always_inline]] BatchKernel(const Batch& batch, std::size_t lane, BodyVelocity* bodies,
                                     const Pair* pairs)
      : lane_(lane),
        bodies_(bodies),
        impulse_{load(batch.impulse.normal), load(batch.impulse.shear),
                 load(batch.impulse.rolling)},
        touching_{.upper = Lanes::velocities(bodies, &batch.upper[lane]),
                  .other = Lanes::velocities(bodies, &batch.other[lane]),
                  .normal_x = load(batch.normal_x),
                  .normal_y = load(batch.normal_y),
                  .pair = Lanes::coefficients(pairs, &batch.pair[lane])} {}

  Int load(const Batch::PerLane<std::int32_t>& from) const { return Lanes::load(&from[lane_]); }
  void store(const Int& value, Batch::PerLane<std::int32_t>& to) const {
    Lanes::store(value, &to[lane_]);
  }
  void store_velocities(const Batch& batch) const {
    Lanes::set_velocities(bodies_, &batch.upper[lane_], touching_.upper);
    Lanes::set_velocities(bodies_, &batch.other[lane_], touching_.other);
  }

  std::size_t lane_;
  BodyVelocity* bodies_;
  Impulse<Int> impulse_;
  ContactKinematics<Int> touching_;
};

}  // namespace clca::contact
