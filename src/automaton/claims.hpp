#pragma once
// Which lead sites more than one mover wants in this step.

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace clca::automaton {

/// Two bits a site: wanted, and wanted by several. The order of the claims does not matter. With
/// `kShared` several threads may call at once.
class Claims {
 public:
  explicit Claims(std::size_t sites)
      : wanted_((sites + 63) / 64, 0), contested_((sites + 63) / 64, 0) {}

  static double bytes_for(double sites) { return sites * (2.0 / 8.0); }

  template <bool kShared>
  void add(std::size_t site) {
    if (set<kShared>(wanted_, site)) {
      set<kShared>(contested_, site);
    }
  }

  template <bool kShared>
  void contest(std::size_t site) {
    set<kShared>(contested_, site);
  }

  bool wanted(std::size_t site) const { return (wanted_[site >> 6U] & bit(site)) != 0; }
  bool contested(std::size_t site) const { return (contested_[site >> 6U] & bit(site)) != 0; }

  /// Forgets the claims in the word of `site`.
  template <bool kShared>
  void clear(std::size_t site) {
    if constexpr (kShared) {
      std::atomic_ref(wanted_[site >> 6U]).store(0, std::memory_order_relaxed);
      std::atomic_ref(contested_[site >> 6U]).store(0, std::memory_order_relaxed);
    } else {
      wanted_[site >> 6U] = 0;
      contested_[site >> 6U] = 0;
    }
  }

 private:
  static std::uint64_t bit(std::size_t site) { return std::uint64_t{1} << (site & 63U); }

  /// Sets the bit of `site` and tells whether it was set before.
  template <bool kShared>
  static bool set(std::vector<std::uint64_t>& words, std::size_t site) {
    std::uint64_t& word = words[site >> 6U];
    if constexpr (kShared) {
      const auto before = std::atomic_ref(word).fetch_or(bit(site), std::memory_order_relaxed);
      return (before & bit(site)) != 0;
    } else {
      const std::uint64_t before = std::exchange(word, word | bit(site));
      return (before & bit(site)) != 0;
    }
  }

  std::vector<std::uint64_t> wanted_;
  std::vector<std::uint64_t> contested_;
};

}  // namespace clca::automaton
