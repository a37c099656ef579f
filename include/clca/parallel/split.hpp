#pragma once
// Loops divided among threads.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace clca::parallel {

/// The threads of a loop.
struct Threads {
  int count = 1;
  std::size_t min_per_thread = 1;  ///< fewer numbers are not worth a thread
};

/// Divides the range [0, count) into at most as many parts as there are threads and calls
/// work(part, first, last) for all parts in parallel.
/// Rethrows the first exception.
void split(const Threads& threads, std::size_t count,
           const std::function<void(std::size_t part, std::size_t first, std::size_t last)>& work);

/// One list for each part of a loop.
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
  /// In the order of the range.
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
