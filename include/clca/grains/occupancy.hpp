#pragma once
// Who occupies each site.

#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "clca/grains/footprint.hpp"
#include "clca/grains/lazy_array.hpp"
#include "clca/grains/site_bits.hpp"
#include "clca/grains/state.hpp"

namespace clca::grains {

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

  /// Places in memory, as lattice::Lattice::memory_size.
  std::size_t places() const { return not_owners_.size(); }
  bool taken(std::size_t index) const { return taken_.test(index); }
  /// Whether a site is taken from `low` to `high`, both included, of the box or its border.
  bool any_taken(lattice::Site low, lattice::Site high) const { return taken_.any(low, high); }
  /// Of the window whose lower left site this is, see SiteBits.
  SiteBits::Corner corner(lattice::Site site) const { return taken_.corner(site); }
  /// Which sites of a window are taken.
  std::uint64_t window(SiteBits::Corner at) const { return taken_.window(at); }
  /// The first owner: a wall comes before particles, a lower id before a higher one.
  Owner owner(std::size_t index) const { return ~not_owners_[index]; }
  /// kFree where there is none.
  Owner second_owner(std::size_t index) const { return seconds_.empty() ? kFree : seconds_[index]; }
  /// Whether this is one of the owners.
  bool has(std::size_t index, Owner owner) const {
    return this->owner(index) == owner || second_owner(index) == owner;
  }
  /// Takes a place that may have an owner already, but not two. Throws std::logic_error otherwise.
  void add(std::size_t index, Owner owner);
  /// Takes one of the owners away. Returns true when the place is free now.
  bool remove(std::size_t index, Owner owner);

  void take(std::size_t index, Owner owner) {
    taken_.set(index);
    set_owner(index, owner);
  }
  void release(std::size_t index) {
    taken_.clear(index);
    set_owner(index, kFree);
  }

  // A move in parts: the sites that change, free to taken and taken to free, and who comes or has
  // left. With `shared` while other threads are busy with other sites.
  void flip(SiteBits::Corner at, std::uint64_t window) { taken_.flip(at, window); }
  void flip_shared(SiteBits::Corner at, std::uint64_t window) { taken_.flip_shared(at, window); }
  void set_taken_shared(std::size_t index) { taken_.set_shared(index); }
  void set_free_shared(std::size_t index) { taken_.clear_shared(index); }
  void set_owner_shared(std::size_t index, Owner owner) {
    std::atomic_ref(not_owners_[index]).store(~owner, std::memory_order_relaxed);
  }
  /// Of a move from `place`: places that are free afterwards, and places of `owner`.
  void exchange_owners_shared(std::size_t place, const Exchanges& exchanges, Owner owner) {
    const std::span<Owner> all(not_owners_.data(), not_owners_.size());
    for (const Exchange exchange : exchanges) {
      const auto entered = static_cast<std::size_t>(std::ptrdiff_t{exchange.entered});
      const auto left = static_cast<std::size_t>(std::ptrdiff_t{exchange.left});
      std::atomic_ref(all[place + entered]).store(~owner, std::memory_order_relaxed);
      std::atomic_ref(all[place + left]).store(~kFree, std::memory_order_relaxed);
    }
  }
  Owner owner_shared(std::size_t index) const {
    return ~std::atomic_ref(const_cast<Owner&>(not_owners_[index])).load(std::memory_order_relaxed);
  }

  /// The same owners everywhere.
  bool operator==(const Occupancy& other) const;

 private:
  void set_owner(std::size_t index, Owner owner) { not_owners_[index] = ~owner; }

  SiteBits taken_;
  LazyArray<Owner> not_owners_;  // ~ of each, so that untouched memory is free places
  std::vector<Owner> seconds_;   // empty where nothing may overlap
};

}  // namespace clca::grains
