#pragma once
// Which lead sites more than one mover wants in this step.

#include <cstdint>

#include "grains/internal/bitboard.hpp"

namespace clca::automaton {

/// Three bits a site: reserved, contested, and left for later. The order of the calls within a
/// phase does not matter. Windows as in Bitboard; by `access` other threads may work on sites
/// nearby.
class SiteReservations {
 public:
  using Access = grains::Access;
  using Corner = grains::Bitboard::Corner;

  explicit SiteReservations(const lattice::Lattice& lattice)
      : reserved_(lattice), contested_(lattice), deferred_(lattice) {}

  static double bytes_for(double places) { return 3 * grains::Bitboard::bytes_for(places); }

  /// Sites that are reserved already become contested.
  void reserve(Corner at, std::uint64_t sites, Access access) {
    if (const std::uint64_t both = reserved_.set(at, sites, access); both != 0) {
      contested_.set(at, both, access);
    }
  }
  /// While nothing is reserved or released.
  std::uint64_t reserved(Corner at) const { return reserved_.window(at); }
  void contest(Corner at, std::uint64_t sites, Access access) { contested_.set(at, sites, access); }
  /// While nothing is contested any more.
  std::uint64_t contested(Corner at) const { return contested_.window(at); }
  /// Gives contested sites to a mover: they are contested no more.
  void win(Corner at, std::uint64_t sites) { contested_.clear(at, sites); }
  /// Sites whose contests wait until all threads are done with their own.
  void defer(Corner at, std::uint64_t sites, Access access) { deferred_.set(at, sites, access); }
  std::uint64_t deferred(Corner at) const { return deferred_.window(at); }

  // Once the phase is over for all sites; they clear what is around the window, too.
  void release(Corner at, Access access) { reserved_.clear_blocks(at, access); }
  void end_contest(Corner at, Access access) { contested_.clear_blocks(at, access); }
  void end_deferral(Corner at, Access access) { deferred_.clear_blocks(at, access); }

 private:
  grains::Bitboard reserved_;
  grains::Bitboard contested_;
  grains::Bitboard deferred_;
};

}  // namespace clca::automaton
