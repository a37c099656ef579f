#pragma once
// Lists that are filled and emptied in every step.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clca::automaton {

/// Elements in the order in which they came. A bag that is emptied keeps its room.
template <class T>
class Bag {
 public:
  void add(const T& element) { add_if(true, element); }
  /// The element is for the caller to fill in.
  T& add() {
    make_room();
    return begin()[count_++];
  }
  /// Nothing branches on `wanted`, for what a processor cannot guess.
  void add_if(bool wanted, const T& element) {
    make_room();
    begin()[count_] = element;
    count_ += wanted ? 1U : 0U;
  }
  void clear() { count_ = 0; }
  template <class Predicate>
  void erase_if(Predicate predicate) {
    count_ = static_cast<std::size_t>(std::remove_if(begin(), end(), predicate) - begin());
  }

  std::size_t size() const { return count_; }
  T* begin() { return room_.data(); }
  T* end() { return begin() + count_; }
  const T* begin() const { return room_.data(); }
  const T* end() const { return begin() + count_; }

 private:
  void make_room() {
    if (count_ == most_) {
      room_.resize(2 * count_ + 1);
      most_ = room_.size();
    }
  }

  std::vector<T> room_;
  std::size_t most_ = 0;  // its size
  std::size_t count_ = 0;
};

}  // namespace clca::automaton
