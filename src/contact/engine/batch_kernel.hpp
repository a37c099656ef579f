#pragma once
// A batch by numbers of some width: `Lanes` says how to load and store them.

#include "contact/engine/batch.hpp"

namespace clca::contact {

/// Contacts of a batch from `lane` on, as many as Lanes::Int has numbers.
template <class Lanes>
class BatchKernel {
 public:
  using Int = typename Lanes::Int;

  static void apply(const Batch* batches, std::size_t count, Body* bodies, const Pair* pairs,
                    bool turns) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t lane = 0; lane < kLanes; lane += Lanes::kWidth) {
        BatchKernel kernel(batches[i], lane, bodies, pairs);
        contact::apply(kernel.touching_, kernel.impulse_, turns);
        kernel.store_velocities(batches[i]);
      }
    }
  }

  static void sweep(Batch* batches, std::size_t count, Body* bodies, const Pair* pairs,
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
  [[gnu::always_inline]] BatchKernel(const Batch& batch, std::size_t lane, Body* bodies,
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
  Body* bodies_;
  Impulse<Int> impulse_;
  ContactState<Int> touching_;
};

}  // namespace clca::contact
