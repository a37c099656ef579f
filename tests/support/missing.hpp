#pragma once
// Tests of what a machine may not have.

#include <gtest/gtest.h>

#include <cstdlib>

/// Skips the test and says why. Fails instead where CLCA_CI is set: CI has to have all that
/// scripts/packages.txt lists.
#define CLCA_SKIP_AS_MISSING(what)           \
  do {                                       \
    if (std::getenv("CLCA_CI") != nullptr) { \
      FAIL() << (what);                      \
    }                                        \
    GTEST_SKIP() << (what);                  \
  } while (false)
