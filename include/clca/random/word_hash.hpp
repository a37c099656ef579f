#pragma once
// Hash of a sequence of 64-bit words, used for states.

#include <cstdint>

namespace clca::random {

/// Chains words with the finaliser of SplitMix64 (Steele et al. 2014).
class WordHash {
 public:
  void add(std::uint64_t word) {
    std::uint64_t mixed = value_ ^ (word + 0x9e3779b97f4a7c15U + (value_ << 6U));
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
    value_ = mixed ^ (mixed >> 31U);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace clca::random
