#pragma once
// The owner of each site.

#include <atomic>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/bitboard.hpp"
#include "grains/internal/lazy_array.hpp"

namespace clca::grains {

/// The owners of each site, and a bit whether it is taken, which windows of moves test.
class OccupancyTable : public Occupancy {
 public:
  /// Enters border, walls and particles. Throws as Occupancy.
  explicit OccupancyTable(const State& state);

  /// Bytes for a lattice with this index_count().
  static double bytes_for(double index_count, bool overlaps) {
    return index_count * ((overlaps ? 2.0 : 1.0) * sizeof(Owner) + 1.0 / 8.0);
  }

  /// The window whose lower left site this is, see Bitboard.
  Bitboard::Corner corner(lattice::Site site) const { return taken_.corner(site); }
  /// The taken sites of a window.
  std::uint64_t window(Bitboard::Corner at) const { return taken_.window(at); }
  /// Adds an owner. Throws std::logic_error if there are two already.
  void add_owner(std::size_t index, Owner owner);
  /// Removes an owner. Returns true if the site is free now.
  bool remove_owner(std::size_t index, Owner owner);

  void take(std::size_t index, Owner owner) {
    taken_.set(index);
    set_owner(index, owner);
  }
  void release(std::size_t index) {
    taken_.clear(index);
    set_owner(index, kFree);
  }

  // A move in parts: the sites that change between free and taken, and their owners. Owners may be
  // loaded and stored while other threads change other sites.
  void flip(Bitboard::Corner at, std::uint64_t window, Access access) {
    taken_.flip(at, window, access);
  }
  void store_owner(std::size_t index, Owner owner) {
    std::atomic_ref(inverted_owners_[index]).store(~owner, std::memory_order_relaxed);
  }
  Owner load_owner(std::size_t index) const {
    return ~std::atomic_ref(inverted_owners_[index]).load(std::memory_order_relaxed);
  }

 private:
  void set_owner(std::size_t index, Owner owner) { inverted_owners_[index] = ~owner; }

  Bitboard taken_;
  // The base class shows them; moved, not copied.
  LazyArray<Owner> inverted_memory_;  // untouched memory means free sites
  std::vector<Owner> second_memory_;
};
static_assert(!std::is_copy_constructible_v<OccupancyTable>);

}  // namespace clca::grains
