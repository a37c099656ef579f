// One contact of a batch after the other.

#include "contact/engine/batch_kernel.hpp"

namespace clca::contact {

namespace {

struct OneLane {
  using Int = std::int32_t;
  static constexpr std::size_t kWidth = 1;

  static Int load(const std::int32_t* from) { return *from; }
  static void store(Int value, std::int32_t* to) { *to = value; }
  static Pair coefficients(const Pair* pairs, const std::int32_t* at) { return pairs[*at]; }
  static Velocity<Int> velocities(const Body* bodies, const std::int32_t* at) {
    return bodies[*at].velocity;
  }
  static void set_velocities(Body* bodies, const std::int32_t* at, const Velocity<Int>& velocity) {
    bodies[*at].velocity = velocity;
  }
};

}  // namespace

BatchFunctions plain_functions() {
  return {.apply = BatchKernel<OneLane>::apply, .sweep = BatchKernel<OneLane>::sweep};
}

}  // namespace clca::contact
