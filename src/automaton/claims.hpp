#pragma once
// Which lead sites more than one mover wants in this step.

#include <atomic>
#include <cstdint>
#include <vector>

namespace clca::automaton {

/// Two bits a site: wanted, and wanted by several. The order of the claims does not matter.
class Claims {
 public:
  explicit Claims(std::size_t sites)
      : wanted_((sites + 63) / 64, 0), contested_((sites + 63) / 64, 0) {}

  static double bytes_for(double sites) { return sites * (2.0 / 8.0); }

  template <bool kShared>
  void add(std::size_t site) {
    if constexpr (kShared) {
      std::atomic_ref<std::uint64_t> wanted(wanted_[site >> 6U]);
      if ((wanted.fetch_or(bit(site), std::memory_order_relaxed) & bit(site)) != 0) {
        std::atomic_ref<std::uint64_t> contested(contested_[site >> 6U]);
        contested.fetch_or(bit(site), std::memory_order_relaxed);
      }
    } else {
      contested_[site >> 6U] |= wanted_[site >> 6U] & bit(site);
      wanted_[site >> 6U] |= bit(site);
    }
  }

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

  std::vector<std::uint64_t> wanted_;
  std::vector<std::uint64_t> contested_;
};

}  // namespace clca::automaton
