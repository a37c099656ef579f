#pragma once
// The particles to look at in a step.

#include <cstdint>
#include <span>
#include <vector>

#include "automaton/bag.hpp"

namespace clca::automaton {

/// A set of ids below a bound: those listed, and those marked, whose records somebody else has.
/// What it costs to go through it and to empty it follows from how many are in it; neighbours in
/// the box that came one after the other stay so.
class AwakeSet {
 public:
  void resize(std::size_t bound) { words_.resize((bound + kBits - 1) / kBits, 0); }

  /// Lists an id, unless it is in the set.
  void insert(std::uint32_t id) {
    std::uint64_t& word = words_[id / kBits];
    listed_.add_if((word & bit(id)) == 0, id);
    word |= bit(id);
  }
  /// For an id that is not in the set.
  void mark(std::uint32_t id) {
    words_[id / kBits] |= bit(id);
    marked_.add(id);
  }
  /// From now on those marked are listed.
  void list_marked() {
    for (const std::uint32_t id : marked_) {
      listed_.add(id);
    }
    marked_.clear();
  }

  bool contains(std::uint32_t id) const { return (words_[id / kBits] & bit(id)) != 0; }
  bool empty() const { return listed_.size() == 0 && marked_.size() == 0; }

  /// In the order in which they came.
  std::span<const std::uint32_t> listed() const { return {listed_.begin(), listed_.end()}; }

  void clear() {
    for (Bag<std::uint32_t>* ids : {&listed_, &marked_}) {
      for (const std::uint32_t id : *ids) {
        words_[id / kBits] = 0;
      }
      ids->clear();
    }
  }

 private:
  static constexpr std::size_t kBits = 64;

  static std::uint64_t bit(std::uint32_t id) { return std::uint64_t{1} << (id % kBits); }

  std::vector<std::uint64_t> words_;
  Bag<std::uint32_t> listed_;
  Bag<std::uint32_t> marked_;
};

}  // namespace clca::automaton
