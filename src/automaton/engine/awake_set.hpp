#pragma once
// Lists and sets that are filled and cleared in every step.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace clca::automaton {

/// Elements in the order in which they were added. Memory is kept when it is cleared; unlike
/// std::vector, it neither constructs nor destroys what it has room for.
template <class T>
class ReusableBuffer {
 public:
  void add(const T& element) { add() = element; }
  /// Without a branch on `wanted`, for what a processor cannot predict.
  void add_if(bool wanted, const T& element) {
    add(element);
    count_ -= wanted ? 0U : 1U;
  }
  /// The new element holds what was there before; the caller fills it in.
  T& add() {
    if (count_ == capacity_) {
      elements_.resize(2 * count_ + 1);
      capacity_ = elements_.size();
    }
    return begin()[count_++];
  }
  void clear() { count_ = 0; }
  template <class Predicate>
  void erase_if(Predicate predicate) {
    count_ = static_cast<std::size_t>(std::remove_if(begin(), end(), predicate) - begin());
  }

  std::size_t size() const { return count_; }
  T* begin() { return elements_.data(); }
  T* end() { return begin() + count_; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return begin() + count_; }

 private:
  std::vector<T> elements_;
  std::size_t capacity_ = 0;  // its size
  std::size_t count_ = 0;
};

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
