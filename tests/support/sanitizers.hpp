#pragma once
// What a sanitizer takes away.

namespace clca::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kLimitsMemoryOfChildren = false;
#elif defined(__has_feature)
inline constexpr bool kLimitsMemoryOfChildren =
    !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
inline constexpr bool kLimitsMemoryOfChildren = true;
#endif

}  // namespace clca::testing
