// All contacts of a batch at once. This file is compiled for processors with AVX2 and says so to
// those who have none: nothing in it may be called before fastest_functions() has asked.

#include "contact/engine/batch_kernel.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace clca::contact {

#ifdef __AVX2__

namespace {

/// Eight whole numbers.
struct Ints {
  __m256i values;

  friend Ints operator+(Ints one, Ints other) {
    return {_mm256_add_epi32(one.values, other.values)};
  }
  friend Ints operator-(Ints one, Ints other) {
    return {_mm256_sub_epi32(one.values, other.values)};
  }
  Ints operator-() const { return {_mm256_sub_epi32(_mm256_setzero_si256(), values)}; }
};

/// Eight long ones: those of even lanes, and those of odd ones.
struct Longs {
  __m256i even;
  __m256i odd;

  friend Longs operator+(Longs one, Longs other) {
    return {_mm256_add_epi64(one.even, other.even), _mm256_add_epi64(one.odd, other.odd)};
  }
  friend Longs operator-(Longs one, Longs other) {
    return {_mm256_sub_epi64(one.even, other.even), _mm256_sub_epi64(one.odd, other.odd)};
  }
  Longs operator-() const {
    const __m256i zero = _mm256_setzero_si256();
    return {_mm256_sub_epi64(zero, even), _mm256_sub_epi64(zero, odd)};
  }
};

Ints all(std::int32_t value, Ints /*like*/) {
  return {_mm256_set1_epi32(value)};
}

Longs product(Ints one, Ints other) {
  const auto odd = [](Ints ints) { return _mm256_srli_epi64(ints.values, 32); };
  return {_mm256_mul_epi32(one.values, other.values), _mm256_mul_epi32(odd(one), odd(other))};
}

Longs wide(Ints ints) {
  return product(ints, {_mm256_set1_epi32(1)});
}

/// AVX2 has no shift of long numbers that keeps the sign: what is shifted is made positive before.
__m256i scaled(__m256i longs, int bits) {
  constexpr std::int64_t kOffset = std::int64_t{1} << 62;
  const __m256i positive =
      _mm256_add_epi64(longs, _mm256_set1_epi64x(kOffset + (std::int64_t{1} << (bits - 1))));
  return _mm256_sub_epi64(_mm256_srli_epi64(positive, bits), _mm256_set1_epi64x(kOffset >> bits));
}
Longs scaled(Longs longs, int bits) {
  return {scaled(longs.even, bits), scaled(longs.odd, bits)};
}

Ints lower(Longs longs) {
  constexpr int kOddLanes = 0b10101010;
  return {_mm256_blend_epi32(longs.even, _mm256_slli_epi64(longs.odd, 32), kOddLanes)};
}

Ints clamped(Ints ints, Ints low, Ints high) {
  return {_mm256_min_epi32(_mm256_max_epi32(ints.values, low.values), high.values)};
}
Ints clamped(Ints ints, std::int32_t low, std::int32_t high) {
  return clamped(ints, Ints{_mm256_set1_epi32(low)}, Ints{_mm256_set1_epi32(high)});
}
__m256i clamped(__m256i longs, std::int32_t low, std::int32_t high) {
  const __m256i lowest = _mm256_set1_epi64x(low);
  const __m256i highest = _mm256_set1_epi64x(high);
  longs = _mm256_blendv_epi8(longs, lowest, _mm256_cmpgt_epi64(lowest, longs));
  return _mm256_blendv_epi8(longs, highest, _mm256_cmpgt_epi64(longs, highest));
}
Ints clamped(Longs longs, std::int32_t low, std::int32_t high) {
  return lower({clamped(longs.even, low, high), clamped(longs.odd, low, high)});
}

struct EightLanes {
  using Int = Ints;
  static constexpr std::size_t kWidth = kLanes;
  static_assert(sizeof(Body) == sizeof(__m128i));

  static Int load(const std::int32_t* from) {
    return {_mm256_load_si256(reinterpret_cast<const __m256i*>(from))};
  }
  static void store(Int value, std::int32_t* to) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(to), value.values);
  }
  static Velocity<Int> velocities(const Body* bodies, const std::int32_t* at) {
    const auto row = [&](std::size_t lane) {
      return _mm_load_si128(reinterpret_cast<const __m128i*>(&bodies[at[lane]]));
    };
    const auto rows = [&](std::size_t lane) { return _mm256_set_m128i(row(lane + 4), row(lane)); };
    const __m256i first = rows(0);
    const __m256i second = rows(1);
    const __m256i third = rows(2);
    const __m256i fourth = rows(3);
    const __m256i xy_before = _mm256_unpacklo_epi32(first, second);
    const __m256i xy_behind = _mm256_unpacklo_epi32(third, fourth);
    return {{_mm256_unpacklo_epi64(xy_before, xy_behind)},
            {_mm256_unpackhi_epi64(xy_before, xy_behind)},
            {_mm256_unpacklo_epi64(_mm256_unpackhi_epi32(first, second),
                                   _mm256_unpackhi_epi32(third, fourth))}};
  }
  static void set_velocities(Body* bodies, const std::int32_t* at, const Velocity<Int>& velocity) {
    const __m256i zero = _mm256_setzero_si256();
    const __m256i xy_before = _mm256_unpacklo_epi32(velocity.x.values, velocity.y.values);
    const __m256i xy_behind = _mm256_unpackhi_epi32(velocity.x.values, velocity.y.values);
    const __m256i spin_before = _mm256_unpacklo_epi32(velocity.spin.values, zero);
    const __m256i spin_behind = _mm256_unpackhi_epi32(velocity.spin.values, zero);
    const auto set = [&](std::size_t lane, __m256i rows) {
      const auto place = [&](std::size_t one) {
        return reinterpret_cast<__m128i*>(&bodies[at[one]]);
      };
      _mm_store_si128(place(lane), _mm256_castsi256_si128(rows));
      _mm_store_si128(place(lane + 4), _mm256_extracti128_si256(rows, 1));
    };
    set(0, _mm256_unpacklo_epi64(xy_before, spin_before));
    set(1, _mm256_unpackhi_epi64(xy_before, spin_before));
    set(2, _mm256_unpacklo_epi64(xy_behind, spin_behind));
    set(3, _mm256_unpackhi_epi64(xy_behind, spin_behind));
  }
};

}  // namespace

BatchFunctions fastest_functions() {
  if (!static_cast<bool>(__builtin_cpu_supports("avx2"))) {
    return plain_functions();
  }
  return {.apply = BatchKernel<EightLanes>::apply, .sweep = BatchKernel<EightLanes>::sweep};
}

#else

BatchFunctions fastest_functions() {
  return plain_functions();
}

#endif

}  // namespace clca::contact
