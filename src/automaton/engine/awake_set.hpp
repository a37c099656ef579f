#pragma once
// The particles to examine in a step.

#include <cstdint>
#include <span>
#include <vector>

#include "automaton/engine/reusable_buffer.hpp"

namespace clca::automaton {

/// A set of ids. Going through it and clearing it costs time by how many are in it, not by how many
/// could be.
class AwakeSet {
 public:
  /// Ids have to be below `bound`.
  void resize(std::size_t bound) { words_.resize((bound + kBits - 1) / kBits, 0); }

  /// Adds an id, unless it is in the set.
  void insert(std::uint32_t id) {
    std::uint64_t& word = words_[id / kBits];
    listed_.add_if((word & bit(id)) == 0, id);
    word |= bit(id);
  }
  bool contains(std::uint32_t id) const { return (words_[id / kBits] & bit(id)) != 0; }

  /// In the order in which they came.
  std::span<const std::uint32_t> listed() const { return {listed_.begin(), listed_.end()}; }

  void clear() {
    for (const std::uint32_t id : listed_) {
      words_[id / kBits] = 0;
    }
    listed_.clear();
  }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::uint32_t id) { return std::uint64_t{1} << (id % kBits); }

  std::vector<std::uint64_t> words_;
  ReusableBuffer<std::uint32_t> listed_;
};

}  // namespace clca::automaton
