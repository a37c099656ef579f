#pragma once
// The particles to look at in the next step.

#include <cstdint>
#include <span>
#include <vector>

#include "automaton/bag.hpp"

namespace clca::automaton {

/// A set of ids below a bound. What it costs to go through it and to empty it follows from how many
/// are in it; neighbours in the box that came one after the other stay so.
class AwakeSet {
 public:
  void resize(std::size_t bound) { words_.resize((bound + kBits - 1) / kBits, 0); }

  void insert(std::uint32_t id) {
    std::uint64_t& word = words_[id / kBits];
    ids_.add_if((word & bit(id)) == 0, id);
    word |= bit(id);
  }

  bool contains(std::uint32_t id) const { return (words_[id / kBits] & bit(id)) != 0; }

  /// In the order in which they came.
  std::span<const std::uint32_t> ids() const { return {ids_.begin(), ids_.end()}; }

  void clear() {
    for (const std::uint32_t id : ids_) {
      words_[id / kBits] = 0;
    }
    ids_.clear();
  }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::uint32_t id) { return std::uint64_t{1} << (id % kBits); }

  std::vector<std::uint64_t> words_;
  Bag<std::uint32_t> ids_;
};

}  // namespace clca::automaton
