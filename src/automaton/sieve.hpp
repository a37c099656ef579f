#pragma once
// Lists to which most candidates come by chance.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clca::automaton {

/// A list whose elements are added if they are wanted. Nothing branches on that: what a processor
/// cannot guess it is not asked.
template <class T>
class Sieve {
 public:
  void add_if(bool wanted, const T& element) {
    if (count_ == elements_.size()) {
      elements_.resize(2 * count_ + 1);
    }
    elements_[count_] = element;
    count_ += wanted ? 1U : 0U;
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
  std::vector<T> elements_;  // and some that are not wanted behind them
  std::size_t count_ = 0;
};

}  // namespace clca::automaton
