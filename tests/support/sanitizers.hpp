#pragma once
// Whether tests run under a sanitizer, which limits neither memory nor what it does itself.

namespace clca::testing {

#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kThreadSanitized = __has_feature(thread_sanitizer);
#else
inline constexpr bool kThreadSanitized = false;
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace clca::testing

/// Skips a test that limits the size of files, where the thread sanitizer maps one of its own.
#define CLCA_SKIP_IF_THREAD_SANITIZED()                                      \
  do {                                                                       \
    if (::clca::testing::kThreadSanitized) {                                 \
      GTEST_SKIP() << "the limit cuts a file of the thread sanitizer short"; \
    }                                                                        \
  } while (false)
