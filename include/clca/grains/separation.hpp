#pragma once
// How deep two particles overlap: unit moves needed to separate them.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// Depths of one shape in another for every way they can overlap, found once from their Minkowski
/// difference.
class SeparationTable {
 public:
  SeparationTable(const lattice::Shape& first, const lattice::Shape& second);

  /// Least number of unit moves of `second`, whose reference site lies at `apart` from that of
  /// `first`, after which the two share no site; 0 when they share none.
  int depth(lattice::Axial apart) const;
  /// The same in a periodic box of so many columns: the deepest of all images. Throws
  /// std::invalid_argument unless they are positive and even.
  int depth(lattice::Axial apart, int columns) const;

 private:
  std::size_t place(lattice::Axial apart) const;

  lattice::Axial low_;  // of the table
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint16_t> depths_;
};

/// The tables of a state's kinds, each made when it is first asked for.
class Separation {
 public:
  explicit Separation(const State& state) : kinds_(state.kinds), lattice_(state.lattice) {}

  /// Unit moves needed to separate the two particles, 0 when they do not overlap. Where they meet
  /// on both ways round a periodic box, the deeper counts.
  int depth(const Particle& first, const Particle& second) { return depth(first, second, {}); }
  /// The same if `first` stood further by `shift`.
  int depth(const Particle& first, const Particle& second, lattice::Axial shift);

 private:
  std::vector<Kind> kinds_;
  lattice::Lattice lattice_;
  std::map<std::pair<std::uint16_t, std::uint16_t>, SeparationTable> tables_;
};

/// From one site to another, the nearer way round a periodic box.
lattice::Axial nearest_vector(const lattice::Lattice& lattice, lattice::Site from,
                              lattice::Site to);

}  // namespace clca::grains
