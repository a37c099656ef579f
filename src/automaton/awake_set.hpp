#pragma once
// The particles to look at in the next step.

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace clca::automaton {

/// A set of ids below a bound. A bit of the summary tells whether a word of 64 ids has any, so that
/// what it costs to empty follows from how many are in it.
class AwakeSet {
 public:
  void resize(std::size_t bound) {
    words_.resize((bound + kBits - 1) / kBits, 0);
    summary_.resize((words_.size() + kBits - 1) / kBits, 0);
  }

  void insert(std::uint32_t id) {
    const std::size_t word = id / kBits;
    words_[word] |= bit(id);
    summary_[word / kBits] |= bit(word);
    empty_ = false;
  }

  /// Takes all ids out, ascending, and calls `visit` with each.
  template <class Visit>
  void drain(Visit visit) {
    if (std::exchange(empty_, true)) {
      return;
    }
    for (std::size_t entry = 0; entry < summary_.size(); ++entry) {
      for (std::uint64_t filled = std::exchange(summary_[entry], 0); filled != 0;
           filled &= filled - 1) {
        const std::size_t word = kBits * entry + static_cast<std::size_t>(std::countr_zero(filled));
        for (std::uint64_t ids = std::exchange(words_[word], 0); ids != 0; ids &= ids - 1) {
          visit(static_cast<std::uint32_t>(kBits * word) +
                static_cast<std::uint32_t>(std::countr_zero(ids)));
        }
      }
    }
  }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << (number % kBits); }

  std::vector<std::uint64_t> words_;
  std::vector<std::uint64_t> summary_;
  bool empty_ = true;
};

}  // namespace clca::automaton
