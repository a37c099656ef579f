#pragma once
// The owner of each site.

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/bitboard.hpp"
#include "grains/internal/lazy_array.hpp"

namespace clca::grains {

/// What a model keeps of each site: its owners, as in Occupancy, and one bit that says whether it
/// is taken. Moves test the bits; waking and drawing read the owners.
class OccupancyTable {
 public:
  /// Enters border, walls and particles. Throws as Occupancy.
  explicit OccupancyTable(const State& state);

  /// Bytes for a lattice with this index_count().
  static double bytes_for(double index_count, bool overlaps) {
    return index_count * ((overlaps ? 2.0 : 1.0) * sizeof(Owner) + 1.0 / 8.0);
  }

  /// Number of indices, as lattice::Lattice::index_count.
  std::size_t index_count() const { return inverted_owners_.size(); }
  bool taken(std::size_t index) const { return taken_.test(index); }
  /// The window whose lower left site this is, see Bitboard.
  Bitboard::Corner corner(lattice::Site site) const { return taken_.corner(site); }
  /// The taken sites of a window.
  std::uint64_t window(Bitboard::Corner at) const { return taken_.window(at); }
  Owner owner(std::size_t index) const { return ~inverted_owners_[index]; }
  Owner second_owner(std::size_t index) const {
    return second_owners_.empty() ? kFree : second_owners_[index];
  }
  bool has(std::size_t index, Owner owner) const {
    return this->owner(index) == owner || second_owner(index) == owner;
  }
  /// Adds an owner. Throws std::logic_error if there are two already.
  void add(std::size_t index, Owner owner);
  /// Removes an owner. Returns true if the site is free now.
  bool remove(std::size_t index, Owner owner);

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
    return ~std::atomic_ref(const_cast<Owner&>(inverted_owners_[index]))
                .load(std::memory_order_relaxed);
  }

  /// Bitwise complements of the first owners.
  std::span<const Owner> inverted_owners() const {
    return {inverted_owners_.data(), inverted_owners_.size()};
  }
  /// Empty if nothing may overlap.
  std::span<const Owner> second_owners() const { return second_owners_; }

  bool operator==(const OccupancyTable& other) const;

 private:
  void set_owner(std::size_t index, Owner owner) { inverted_owners_[index] = ~owner; }

  Bitboard taken_;
  LazyArray<Owner>
      inverted_owners_;  // bitwise complement of each owner: untouched memory means free sites
  std::vector<Owner> second_owners_;  // empty if nothing may overlap
};

}  // namespace clca::grains
