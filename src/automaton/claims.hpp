#pragma once
// Which lead sites more than one mover wants in this step.

#include <cstdint>

#include "clca/automaton/site_bits.hpp"

namespace clca::automaton {

/// Two bits a site: wanted, and wanted by several. The order of the claims does not matter. Windows
/// and places as for SiteBits.
class Claims {
 public:
  explicit Claims(const lattice::Lattice& lattice) : wanted_(lattice), contested_(lattice) {}

  static double bytes_for(double places) { return 2 * SiteBits::bytes_for(places); }

  void add(lattice::Site corner, std::uint64_t window) {
    if (const std::uint64_t both = wanted_.window(corner) & window; both != 0) {
      contested_.set(corner, both);
    }
    wanted_.set(corner, window);
  }
  /// The sites that are wanted. Nobody adds or clears meanwhile.
  std::uint64_t wanted(lattice::Site corner) const { return wanted_.window(corner); }
  bool wanted(std::size_t place) const { return wanted_.test(place); }
  void contest(lattice::Site corner, std::uint64_t window) { contested_.set(corner, window); }
  /// Nobody contests meanwhile.
  std::uint64_t contested(lattice::Site corner) const { return contested_.window(corner); }
  bool contested(std::size_t place) const { return contested_.test(place); }
  void clear(lattice::Site corner, std::uint64_t window) { wanted_.clear(corner, window); }
  void clear_contested(lattice::Site corner, std::uint64_t window) {
    contested_.clear(corner, window);
  }

  // The same while other threads are busy with other sites. A place: a single site.
  void add_shared(lattice::Site corner, std::uint64_t window) {
    if (const std::uint64_t both = wanted_.set_shared(corner, window); both != 0) {
      contested_.set_shared(corner, both);
    }
  }
  void add_shared(std::size_t place) {
    if (wanted_.set_shared(place)) {
      contested_.set_shared(place);
    }
  }
  template <class... Where>
  void contest_shared(Where... where) {
    contested_.set_shared(where...);
  }
  template <class... Where>
  void clear_shared(Where... where) {
    wanted_.clear_shared(where...);
    contested_.clear_shared(where...);
  }

 private:
  SiteBits wanted_;
  SiteBits contested_;
};

}  // namespace clca::automaton
