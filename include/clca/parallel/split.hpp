#pragma once
// Loops shared out among threads.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace clca::parallel {

/// Threads for a loop.
struct Threads {
  int count = 1;
  std::size_t least = 1;  ///< numbers that are worth a thread
};

/// Cuts the numbers from 0 to `count` into at most as many parts as there are threads and calls
/// work(part, first, last) for each, all at the same time. Throws what the first call that failed
/// has thrown.
void split(const Threads& threads, std::size_t count,
           const std::function<void(std::size_t part, std::size_t first, std::size_t last)>& work);

/// Lists that the parts of a loop fill, each its own.
template <class T>
class PartLists {
 public:
  explicit PartLists(const Threads& threads) : parts_(static_cast<std::size_t>(threads.count)) {}

  void clear() {
    for (std::vector<T>& part : parts_) {
      part.clear();
    }
  }
  std::vector<T>& of(std::size_t part) { return parts_[part]; }
  /// In the order of the numbers.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const std::vector<T>& part : parts_) {
      std::for_each(part.begin(), part.end(), visit);
    }
  }

 private:
  std::vector<std::vector<T>> parts_;
};

}  // namespace clca::parallel
