#pragma once
// Which lead sites more than one mover wants in this step.

#include <cstdint>

#include "clca/grains/site_bits.hpp"

namespace clca::automaton {

/// Three bits a site: wanted, wanted by several, and of those the ones still open. The order of the
/// claims does not matter. Windows and places as for SiteBits.
class Claims {
 public:
  using Corner = grains::SiteBits::Corner;

  explicit Claims(const lattice::Lattice& lattice)
      : wanted_(lattice), contested_(lattice), open_(lattice) {}

  static double bytes_for(double places) { return 3 * grains::SiteBits::bytes_for(places); }

  void add(Corner at, std::uint64_t window) {
    if (const std::uint64_t both = wanted_.window(at) & window; both != 0) {
      contested_.set(at, both);
    }
    wanted_.set(at, window);
  }
  /// The sites that are wanted. Nobody adds or forgets meanwhile.
  std::uint64_t wanted(Corner at) const { return wanted_.window(at); }
  bool wanted(std::size_t place) const { return wanted_.test(place); }
  void contest(Corner at, std::uint64_t window) { contested_.set(at, window); }
  /// Nobody contests meanwhile.
  std::uint64_t contested(Corner at) const { return contested_.window(at); }
  bool contested(std::size_t place) const { return contested_.test(place); }
  /// For one of those who contest these sites: there, they are contested no more.
  void win(Corner at, std::uint64_t window) { contested_.clear(at, window); }
  void win(std::size_t place) { contested_.clear(place); }
  /// Whether a site is one of those that have been left open.
  bool open(Corner at, std::uint64_t window) const { return (open_.window(at) & window) != 0; }
  void leave_open(Corner at, std::uint64_t window) { open_.set(at, window); }
  // For when all claims, or all contests, are over: windows and what is around them.
  void forget(Corner at) { wanted_.wipe(at); }
  void end_contest(Corner at) { contested_.wipe(at); }

  // The same while other threads are busy with other sites. A place: a single site.
  void add_shared(Corner at, std::uint64_t window) {
    if (const std::uint64_t both = wanted_.set_shared(at, window); both != 0) {
      contested_.set_shared(at, both);
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
  void forget_shared(Corner at) { wanted_.wipe_shared(at); }
  void forget_shared(std::size_t place) { wanted_.clear_shared(place); }
  template <class... Where>
  void leave_open_shared(Where... where) {
    open_.set_shared(where...);
  }
  void end_contest_shared(Corner at) { contested_.wipe_shared(at); }
  void end_contest_shared(std::size_t place) { contested_.clear_shared(place); }
  void close_shared(Corner at) { open_.wipe_shared(at); }
  void close_shared(std::size_t place) { open_.clear_shared(place); }

 private:
  grains::SiteBits wanted_;
  grains::SiteBits contested_;
  grains::SiteBits open_;
};

}  // namespace clca::automaton
