#pragma once
// Which lead sites more than one mover wants in this step.

#include <cstdint>

#include "grains/internal/bitboard.hpp"

namespace clca::automaton {

/// Two bits a site: reserved and contested. The order of the calls within a
/// phase does not matter. Windows as in Bitboard; by `access` other threads may work on sites
/// nearby.
class SiteReservations {
 public:
  using Access = grains::Access;
  using Corner = grains::Bitboard::Corner;

  explicit SiteReservations(const lattice::Lattice& lattice)
      : reserved_(lattice), contested_(lattice) {}

  static double bytes_for(double index_count) {
    return 2 * grains::Bitboard::bytes_for(index_count);
  }

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

  // Once the phase is over for all sites; they clear what is around the window, too.
  void release(Corner at, Access access) { reserved_.clear_blocks(at, access); }
  void end_contest(Corner at, Access access) { contested_.clear_blocks(at, access); }

 private:
  grains::Bitboard reserved_;
  grains::Bitboard contested_;
};

}  // namespace clca::automaton
