#pragma once
// The particles to look at in the next step.

#include <atomic>
#include <bit>
#include <cstdint>
#include <vector>

namespace clca::automaton {

/// A set of ids below a bound that is emptied in ascending order.
class AwakeSet {
 public:
  void resize(std::size_t bound) { words_.resize((bound + 63) / 64, 0); }

  void insert(std::uint32_t id) { words_[id >> 6U] |= bit(id); }

  /// Safe to call from several threads at once.
  void insert_shared(std::uint32_t id) {
    std::atomic_ref<std::uint64_t> word(words_[id >> 6U]);
    if ((word.load(std::memory_order_relaxed) & bit(id)) == 0) {
      word.fetch_or(bit(id), std::memory_order_relaxed);
    }
  }

  /// Moves all ids into `ids`, ascending.
  void drain(std::vector<std::uint32_t>& ids) {
    ids.clear();
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (std::uint64_t word = words_[i]; word != 0; word &= word - 1) {
        ids.push_back(static_cast<std::uint32_t>(64 * i) +
                      static_cast<std::uint32_t>(std::countr_zero(word)));
      }
      words_[i] = 0;
    }
  }

 private:
  static std::uint64_t bit(std::uint32_t id) { return std::uint64_t{1} << (id & 63U); }

  std::vector<std::uint64_t> words_;
};

}  // namespace clca::automaton
