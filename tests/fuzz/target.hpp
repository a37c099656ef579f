#pragma once
// What a fuzz target is: it takes any bytes, and ends the program where an answer is wrong.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace clca::fuzz {

/// Ends the program with a finding.
[[noreturn]] inline void found(const std::string& trouble) {
  std::fprintf(stderr, "found: %s\n", trouble.c_str());
  std::abort();
}

inline void require(bool holds, const std::string& otherwise) {
  if (!holds) {
    found(otherwise);
  }
}

}  // namespace clca::fuzz
