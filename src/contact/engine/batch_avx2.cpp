// All contacts of a batch at once. This file is compiled for processors with AVX2 and says so to
// those who have none: nothing in it may be called before fastest_pass_function() has asked.

#include "contact/engine/batch.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace clca::contact {

#ifdef __AVX2__

namespace {

/// Eight whole numbers.
struct Ints {
  __m256i values;

  Ints operator+(Ints other) const { return {_mm256_add_epi32(values, other.values)}; }
  Ints operator-(Ints other) const { return {_mm256_sub_epi32(values, other.values)}; }
  Ints operator-() const { return {_mm256_sub_epi32(_mm256_setzero_si256(), values)}; }
};

/// Eight numbers of 64 bits: those of even lanes, and those of odd ones.
struct Longs {
  __m256i even;
  __m256i odd;

  Longs operator+(Longs other) const {
    return {_mm256_add_epi64(even, other.even), _mm256_add_epi64(odd, other.odd)};
  }
  Longs operator-(Longs other) const {
    return {_mm256_sub_epi64(even, other.even), _mm256_sub_epi64(odd, other.odd)};
  }
};

Ints in_all_lanes(std::int32_t value, Ints /*like*/) {
  return {_mm256_set1_epi32(value)};
}

Longs product(Ints one, Ints other) {
  const auto odd = [](Ints ints) {
    return _mm256_castps_si256(_mm256_movehdup_ps(_mm256_castsi256_ps(ints.values)));
  };
  return {_mm256_mul_epi32(one.values, other.values), _mm256_mul_epi32(odd(one), odd(other))};
}

Longs with_half(Longs longs, int bits) {
  const __m256i half = _mm256_set1_epi64x(std::int64_t{1} << (bits - 1));
  return longs + Longs{half, half};
}

/// 32 bits of each number, from bit number `bits` on.
Ints shifted(Longs longs, int bits) {
  constexpr int kOddLanes = 0b10101010;
  return {_mm256_blend_epi32(_mm256_srli_epi64(longs.even, bits),
                             _mm256_slli_epi64(longs.odd, 32 - bits), kOddLanes)};
}

Ints rounded(Longs longs, int bits) {
  return shifted(with_half(longs, bits), bits);
}

Ints clamped(Ints ints, Ints low, Ints high) {
  return {_mm256_min_epi32(_mm256_max_epi32(ints.values, low.values), high.values)};
}
Ints clamped(Ints ints, std::int32_t low, std::int32_t high) {
  return clamped(ints, in_all_lanes(low, ints), in_all_lanes(high, ints));
}

/// limited() of numbers.hpp, by the upper halves of the numbers alone.
Ints limited(Longs longs, int bits, std::int32_t most) {
  const std::int64_t upper = most >> (32 - bits);
  const __m256i low = _mm256_set1_epi64x((-upper - 1) * (std::int64_t{1} << 32) + 0x80000000);
  const __m256i high = _mm256_set1_epi64x(upper * (std::int64_t{1} << 32) + 0x7fffffff);
  const auto kept = [&](__m256i value) {
    return _mm256_min_epi32(_mm256_max_epi32(value, low), high);
  };
  const Longs all = with_half(longs, bits);
  return shifted({kept(all.even), kept(all.odd)}, bits);
}

/// Takes a row of four numbers for each lane and returns the first numbers of all lanes, then the
/// second, third and fourth ones.
template <class Row>
[[gnu::always_inline]] inline std::array<Ints, 4> columns(Row row) {
  const auto rows = [&](std::size_t lane) { return _mm256_set_m128i(row(lane + 4), row(lane)); };
  const __m256i first = rows(0);
  const __m256i second = rows(1);
  const __m256i third = rows(2);
  const __m256i fourth = rows(3);
  const __m256i low = _mm256_unpacklo_epi32(first, second);
  const __m256i low_next = _mm256_unpacklo_epi32(third, fourth);
  const __m256i high = _mm256_unpackhi_epi32(first, second);
  const __m256i high_next = _mm256_unpackhi_epi32(third, fourth);
  return {Ints{_mm256_unpacklo_epi64(low, low_next)}, Ints{_mm256_unpackhi_epi64(low, low_next)},
          Ints{_mm256_unpacklo_epi64(high, high_next)},
          Ints{_mm256_unpackhi_epi64(high, high_next)}};
}

struct EightLanes {
  using Int = Ints;
  static constexpr std::size_t kWidth = kLanes;
  static_assert(sizeof(AlignedVelocity) == sizeof(__m128i));

  static Int load(const std::int32_t* from) {
    return {_mm256_load_si256(reinterpret_cast<const __m256i*>(from))};
  }
  static void store(Int value, std::int32_t* to) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(to), value.values);
  }
  static Coefficients<Int> coefficients(const PairCoefficients* pairs, const std::int32_t* at) {
    static_assert(sizeof(PairCoefficients) == 2 * sizeof(__m128i));
    const auto half = [&](std::size_t number) {
      return columns([&](std::size_t lane) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(&pairs[at[lane]]) + number);
      });
    };
    const auto [mass, shear_mass, upper_inverse_mass, other_inverse_mass] = half(0);
    const auto [upper_rolling_mass, other_rolling_mass, upper_rolling_response,
                other_rolling_response] = half(1);
    return {mass,
            shear_mass,
            upper_inverse_mass,
            other_inverse_mass,
            upper_rolling_mass,
            other_rolling_mass,
            upper_rolling_response,
            other_rolling_response};
  }
  static Velocity<Int> velocities(const AlignedVelocity* bodies, const std::int32_t* at) {
    const auto [x, y, spin, unused] = columns([&](std::size_t lane) {
      return _mm_load_si128(reinterpret_cast<const __m128i*>(&bodies[at[lane]]));
    });
    return {x, y, spin};
  }
  static void set_velocities(AlignedVelocity* bodies, const std::int32_t* at,
                             const Velocity<Int>& velocity) {
    const __m256i zero = _mm256_setzero_si256();
    const __m256i xy_low = _mm256_unpacklo_epi32(velocity.x.values, velocity.y.values);
    const __m256i xy_high = _mm256_unpackhi_epi32(velocity.x.values, velocity.y.values);
    const __m256i spin_low = _mm256_unpacklo_epi32(velocity.spin.values, zero);
    const __m256i spin_high = _mm256_unpackhi_epi32(velocity.spin.values, zero);
    const auto set = [&](std::size_t lane, __m256i rows) {
      const auto address = [&](std::size_t number) {
        return reinterpret_cast<__m128i*>(&bodies[at[number]]);
      };
      _mm_store_si128(address(lane), _mm256_castsi256_si128(rows));
      _mm_store_si128(address(lane + 4), _mm256_extracti128_si256(rows, 1));
    };
    set(0, _mm256_unpacklo_epi64(xy_low, spin_low));
    set(1, _mm256_unpackhi_epi64(xy_low, spin_low));
    set(2, _mm256_unpacklo_epi64(xy_high, spin_high));
    set(3, _mm256_unpackhi_epi64(xy_high, spin_high));
  }
};

}  // namespace

PassFunction fastest_pass_function() {
  return static_cast<bool>(__builtin_cpu_supports("avx2")) ? carry_out_pass<EightLanes>
                                                           : plain_pass_function();
}

#else

PassFunction fastest_pass_function() {
  return plain_pass_function();
}

#endif

}  // namespace clca::contact
