#pragma once
// Who occupies each site.

#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// Besides particles and walls (see Owner) a place may be free or on the border of the box.
inline constexpr Owner kFree = -1;
inline constexpr Owner kBorder = std::numeric_limits<Owner>::min();

/// Owner of each place of a lattice, and whether it is taken as one bit, both indexed as
/// lattice::Lattice::index. The bits are what moves look at; the owners serve waking and drawing.
/// Where walls let overlap (may_overlap) a place may have two owners, no more.
class Occupancy {
 public:
  /// The box with its border, walls and particles. Throws std::invalid_argument when a particle
  /// overlaps a wall or another particle without a Push that says so, or leaves the box, when a
  /// place has three owners, when a wall that moves stands in another one, or when a kind is as
  /// wide as a periodic box.
  explicit Occupancy(const State& state);

  /// Bytes that a lattice of this many places needs.
  static double bytes_for(double places, bool overlaps) {
    return places * ((overlaps ? 2.0 : 1.0) * sizeof(Owner) + 1.0 / 8.0);
  }

  bool taken(std::size_t index) const { return (words_[index >> 6U] >> (index & 63U) & 1U) != 0; }
  /// Whether one of the places from `first` to before `end` is taken.
  bool any_taken(std::size_t first, std::size_t end) const {
    const std::uint64_t from_first = ~std::uint64_t{0} << (first & 63U);
    const std::uint64_t before_end = ~(~std::uint64_t{0} << (end & 63U));
    const std::size_t last = end >> 6U;
    std::uint64_t taken = 0;
    for (std::size_t word = first >> 6U; word < last; ++word) {
      taken |= words_[word] & (word == first >> 6U ? from_first : ~std::uint64_t{0});
    }
    const std::uint64_t from = first >> 6U == last ? from_first : ~std::uint64_t{0};
    return taken != 0 || ((end & 63U) != 0 && (words_[last] & before_end & from) != 0);
  }
  Owner owner(std::size_t index) const { return owners_[index]; }
  /// The first owner of each place; a wall comes before particles, a lower id before a higher one.
  const std::vector<Owner>& owners() const { return owners_; }
  /// kFree where there is none.
  Owner second_owner(std::size_t index) const { return seconds_.empty() ? kFree : seconds_[index]; }
  /// Whether this is one of the owners.
  bool has(std::size_t index, Owner owner) const {
    return owners_[index] == owner || second_owner(index) == owner;
  }
  /// Takes a place that may have an owner already, but not two. Throws std::logic_error otherwise.
  void add(std::size_t index, Owner owner);
  /// Takes one of the owners away. Returns true when the place is free now.
  bool remove(std::size_t index, Owner owner);

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
  std::vector<Owner> seconds_;  // empty where nothing may overlap
};

}  // namespace clca::automaton
