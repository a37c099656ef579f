#pragma once
// Who occupies each site.

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// A particle id, or one of the codes below; walls are numbered down from kFirstWall.
using Owner = std::int32_t;
inline constexpr Owner kFree = -1;
inline constexpr Owner kFirstWall = -2;
inline constexpr Owner kBorder = std::numeric_limits<Owner>::min();

constexpr bool is_particle(Owner owner) {
  return owner >= 0;
}
constexpr bool is_wall(Owner owner) {
  return owner <= kFirstWall;
}

/// Owner of each place of a lattice, and whether it is taken as one bit, both indexed as
/// lattice::Lattice::index. The bits are what moves look at; the owners serve waking and drawing.
class Occupancy {
 public:
  /// The box with its border, walls and particles. Throws std::invalid_argument when a particle
  /// overlaps a wall or another particle, or leaves the box, or when a kind is as wide as a
  /// periodic box.
  explicit Occupancy(const State& state);

  /// Bytes that a lattice of this many places needs.
  static double bytes_for(double places) { return places * (sizeof(Owner) + 1.0 / 8.0); }

  bool taken(std::size_t index) const { return (words_[index >> 6U] >> (index & 63U) & 1U) != 0; }
  Owner owner(std::size_t index) const { return owners_[index]; }
  const std::vector<Owner>& owners() const { return owners_; }

  void take(std::size_t index, Owner owner) {
    words_[index >> 6U] |= std::uint64_t{1} << (index & 63U);
    owners_[index] = owner;
  }
  void release(std::size_t index) {
    words_[index >> 6U] &= ~(std::uint64_t{1} << (index & 63U));
    owners_[index] = kFree;
  }
  /// The same while other threads change other sites.
  Owner owner_shared(std::size_t index) const {
    return std::atomic_ref(const_cast<Owner&>(owners_[index])).load(std::memory_order_relaxed);
  }
  void take_shared(std::size_t index, Owner owner) {
    std::atomic_ref word(words_[index >> 6U]);
    word.fetch_or(std::uint64_t{1} << (index & 63U), std::memory_order_relaxed);
    std::atomic_ref(owners_[index]).store(owner, std::memory_order_relaxed);
  }
  void release_shared(std::size_t index) {
    std::atomic_ref word(words_[index >> 6U]);
    word.fetch_and(~(std::uint64_t{1} << (index & 63U)), std::memory_order_relaxed);
    std::atomic_ref(owners_[index]).store(kFree, std::memory_order_relaxed);
  }

  bool operator==(const Occupancy&) const = default;

 private:
  std::vector<std::uint64_t> words_;
  std::vector<Owner> owners_;
};

}  // namespace clca::automaton
