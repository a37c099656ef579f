#pragma once
// Large arrays of which most elements are never touched.

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace clca::grains {

/// A fixed number of zeros. The system provides memory page by page, on the first write.
template <class T>
class LazyArray {
  static_assert(std::is_trivial_v<T>);

 public:
  /// Throws std::bad_alloc.
  explicit LazyArray(std::size_t size)
      : size_(size), data_(zeros(bytes_of(size)), Unmap{bytes_of(size)}) {}

  std::size_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t index) { return data_.get()[index]; }
  const T& operator[](std::size_t index) const { return data_.get()[index]; }

 private:
  struct Unmap {
    std::size_t bytes = 0;
    void operator()(T* data) const {
      if (bytes < kHugePage) {
        std::free(data);  // NOLINT(cppcoreguidelines-no-malloc)
      } else {
        ::munmap(data, bytes);
      }
    }
  };
  static constexpr std::size_t kHugePage = std::size_t{2} << 20U;

  static std::size_t bytes_of(std::size_t size) {
    return std::max<std::size_t>(size, 1) * sizeof(T);
  }
  static T* zeros(std::size_t bytes) {
    if (bytes < kHugePage) {               // memory that was used before costs less than new pages
      void* data = std::calloc(bytes, 1);  // NOLINT(cppcoreguidelines-no-malloc)
      return data != nullptr ? static_cast<T*>(data) : throw std::bad_alloc();
    }
    void* data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (data == MAP_FAILED) {
      throw std::bad_alloc();
    }
    ::madvise(data, bytes, MADV_HUGEPAGE);  // advice only: neighbouring sites are columns apart
    return static_cast<T*>(data);
  }

  std::size_t size_ = 0;
  std::unique_ptr<T, Unmap> data_;
};

}  // namespace clca::grains
