#pragma once
// Damage to the inside of files: always the same for a number.

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

namespace clca::fuzz {

using Bytes = std::vector<std::uint8_t>;

class Damage {
 public:
  explicit Damage(unsigned number) : random_(number) {}

  std::size_t below(std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0,
                                                      std::max<std::size_t>(1, bound) - 1)(random_);
  }
  bool yes() { return below(2) == 1; }
  std::uint64_t any() { return random_(); }

  /// Some changes of `bytes`; `other` is where foreign pieces come from.
  Bytes damaged(Bytes bytes, const Bytes& other) {
    for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
      change(bytes, other);
    }
    return bytes;
  }

  /// What a length, a count or an address is likely to break things with.
  std::uint64_t odd_number(std::uint64_t size) {
    const std::array<std::uint64_t, 12> numbers = {0,
                                                   1,
                                                   size,
                                                   size - 1,
                                                   size + 1,
                                                   2 * size,
                                                   below(size),
                                                   0x7FFFFFFFU,
                                                   0xFFFFFFFFU,
                                                   std::uint64_t{1} << 40U,
                                                   ~std::uint64_t{0} >> 1U,
                                                   ~std::uint64_t{0}};
    return numbers.at(below(numbers.size()));
  }

 private:
  using Place = std::ptrdiff_t;

  /// Anywhere, or where HDF5 has something to say: behind the names of its structures.
  std::size_t place(const Bytes& bytes) {
    constexpr std::array<std::string_view, 5> kNames = {"TREE", "SNOD", "HEAP", "\x89HDF", "OHDR"};
    const std::size_t start = below(bytes.size());
    if (yes()) {
      const std::string_view name = kNames.at(below(kNames.size()));
      const auto found = std::search(bytes.begin() + static_cast<Place>(start), bytes.end(),
                                     name.begin(), name.end());
      const auto at = static_cast<std::size_t>(found - bytes.begin()) + below(64);
      return at < bytes.size() ? at : start;
    }
    return start;
  }

  void change(Bytes& bytes, const Bytes& other) {
    const std::size_t at = place(bytes);
    const auto begin = bytes.begin() + static_cast<Place>(at);
    const std::size_t rest = bytes.size() - at;
    const std::size_t some = std::min(rest, 1 + below(yes() ? 16 : 1024));
    switch (below(9)) {
      case 0:
        *begin = static_cast<std::uint8_t>(*begin ^ (1U << below(8)));
        break;
      case 1:
        *begin = static_cast<std::uint8_t>(any());
        break;
      case 2:
        std::fill_n(begin, some, yes() ? std::uint8_t{0} : std::uint8_t{0xFF});
        break;
      case 3: {
        std::uint64_t number = odd_number(bytes.size());
        for (std::size_t i = 0; i < std::min<std::size_t>(rest, 1U << below(4)); ++i) {
          begin[static_cast<Place>(i)] = static_cast<std::uint8_t>(number);
          number >>= 8U;
        }
        break;
      }
      case 4:
        bytes.resize(at);
        break;
      case 5:
        bytes.erase(begin, begin + static_cast<Place>(some));
        break;
      case 6: {
        const Bytes copy(begin, begin + static_cast<Place>(some));
        bytes.insert(bytes.begin() + static_cast<Place>(below(bytes.size())), copy.begin(),
                     copy.end());
        break;
      }
      case 7: {
        const std::size_t from = below(other.size());
        std::copy_n(other.begin() + static_cast<Place>(from), std::min(some, other.size() - from),
                    begin);
        break;
      }
      default:
        bytes.resize(at);
        bytes.insert(bytes.end(), other.begin() + static_cast<Place>(std::min(at, other.size())),
                     other.end());
    }
  }

  std::mt19937 random_;
};

}  // namespace clca::fuzz
