#pragma once
// The bytes of an input as a row of choices. Where they have ended every choice is the least one.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace clca::fuzz {

class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }

  /// Any number of its type, as its bytes say: NaN and the like, too.
  template <class T>
  T any() {
    static_assert(std::is_arithmetic_v<T>);
    std::array<std::uint8_t, sizeof(T)> bytes = {};
    const auto taken = take(sizeof(T));
    std::copy(taken.begin(), taken.end(), bytes.begin());
    T value = {};
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }
  bool yes() { return any<std::uint8_t>() % 2 == 1; }
  /// From 0 to `most`, both included.
  std::size_t up_to(std::uint32_t most) {
    const std::uint32_t number = most <= 0xFFU ? any<std::uint8_t>() : any<std::uint32_t>();
    return number % (std::uint64_t{most} + 1);
  }
  std::string text(std::uint8_t longest) {
    const auto taken = take(up_to(longest));
    return {taken.begin(), taken.end()};
  }
  std::span<const std::uint8_t> rest() { return take(rest_.size()); }

 private:
  std::span<const std::uint8_t> take(std::size_t count) {
    const auto front = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(front.size());
    return front;
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace clca::fuzz
