#pragma once
// Contacts by eight: those of a batch share no grain, so that they can be solved at once with the
// result of one after the other.

#include <array>
#include <cstdint>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/contact_law.hpp"

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
  PerLane<std::int32_t> pair = {};  ///< Bodies::pair_number
};

/// The velocity of a grain where it is loaded and stored at once.
struct alignas(16) Body {
  Velocity<std::int32_t> velocity;
};

/// How batches are carried out. `pairs`: Bodies::pairs().
struct BatchFunctions {
  /// Gives the bodies the impulses that the contacts remember.
  void (*apply)(const Batch* batches, std::size_t count, Body* bodies, const Pair* pairs,
                bool turns);
  /// Solves all contacts, forwards or backwards.
  void (*sweep)(Batch* batches, std::size_t count, Body* bodies, const Pair* pairs,
                const LawConstants& law, bool backwards);
};
/// One contact after the other.
BatchFunctions plain_functions();
/// Eight at once by AVX2; plain_functions() where the compiler or the processor has none.
BatchFunctions fastest_functions();

}  // namespace clca::contact
