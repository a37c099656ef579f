#pragma once
// Lists that are filled and cleared in every step.

#include <algorithm>
#include <cstddef>
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

}  // namespace clca::automaton
