#pragma once
// The particles to look at in the next step.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
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

  /// Calls `visit` with each id of any of the sets once, ascending, and takes those of the sets:
  /// part number `part` of `parts`. Several threads may do a part each; then each set is to forget.
  /// All sets have the same bound.
  template <class Visit>
  static void drain(std::span<AwakeSet* const> sets, std::size_t part, std::size_t parts,
                    Visit visit) {
    if (std::all_of(sets.begin(), sets.end(), [](const AwakeSet* set) { return set->empty_; })) {
      return;
    }
    const std::size_t count = sets.front()->summary_.size();
    for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i) {
      drain_entry(sets, i, visit);
    }
  }
  /// All that was in the set has been taken.
  void forget() { empty_ = true; }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::size_t number) { return std::uint64_t{1} << (number % kBits); }

  template <class Visit>
  static void drain_entry(std::span<AwakeSet* const> sets, std::size_t entry, Visit visit) {
    std::uint64_t filled = 0;
    for (AwakeSet* set : sets) {
      filled |= set->summary_[entry];
      set->summary_[entry] = 0;
    }
    for (; filled != 0; filled &= filled - 1) {
      const std::size_t word = kBits * entry + static_cast<std::size_t>(std::countr_zero(filled));
      std::uint64_t ids = 0;
      for (AwakeSet* set : sets) {
        ids |= set->words_[word];
        set->words_[word] = 0;
      }
      for (; ids != 0; ids &= ids - 1) {
        visit(static_cast<std::uint32_t>(kBits * word) +
              static_cast<std::uint32_t>(std::countr_zero(ids)));
      }
    }
  }

  std::vector<std::uint64_t> words_;
  std::vector<std::uint64_t> summary_;
  bool empty_ = true;
};

}  // namespace clca::automaton
