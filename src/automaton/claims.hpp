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
    contest(corner, window);
    wanted_.set(corner, window);
  }
  /// Contests those of the sites that are wanted and tells whether there are any.
  bool contest(lattice::Site corner, std::uint64_t window) {
    const std::uint64_t both = wanted_.window(corner) & window;
    if (both != 0) {
      contested_.set(corner, both);
    }
    return both != 0;
  }
  bool contested(lattice::Site corner, std::uint64_t window) const {
    return (contested_.window(corner) & window) != 0;
  }
  /// What was contested says so.
  void clear(lattice::Site corner, std::uint64_t window, bool contested) {
    wanted_.clear(corner, window);
    if (contested) {
      contested_.clear(corner, window);
    }
  }

  // The same for one site, while other threads are busy with others.
  void add_shared(std::size_t place) {
    if (wanted_.set_shared(place)) {
      contested_.set_shared(place);
    }
  }
  bool contest_shared(std::size_t place) {
    const bool both = wanted_.test_shared(place);
    if (both) {
      contested_.set_shared(place);
    }
    return both;
  }
  bool contested_shared(std::size_t place) const { return contested_.test_shared(place); }
  void clear_shared(std::size_t place) {
    wanted_.clear_shared(place);
    contested_.clear_shared(place);
  }

 private:
  SiteBits wanted_;
  SiteBits contested_;
};

}  // namespace clca::automaton
