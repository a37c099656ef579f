#pragma once
// Overlap depth of two particles: unit moves needed to separate them.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "clca/grains/state.hpp"
#include "grains/internal/apart_table.hpp"

namespace clca::grains {

/// Overlap depths of two shapes for every relative position, computed once from their Minkowski
/// difference.
class SeparationTable {
 public:
  SeparationTable(const lattice::Shape& first, const lattice::Shape& second);

  /// Smallest number of unit moves of `second`, placed at `apart` from `first`, after which they
  /// share no site.
  int depth(lattice::Axial apart) const;
  /// The same in a periodic box: the deepest over all images. Throws std::invalid_argument unless
  /// `columns` is positive and even.
  int depth(lattice::Axial apart, int columns) const;

 private:
  ApartTable<std::uint16_t> depths_;
};

/// The tables for all pairs of kinds, each computed on first use.
class Separation {
 public:
  explicit Separation(const State& state) : kinds_(state.kinds), lattice_(state.lattice) {}

  /// Unit moves needed to separate the particles; 0 if they do not overlap. In a periodic box the
  /// deeper of both ways round counts.
  int depth(const Particle& first, const Particle& second) { return depth(first, second, {}); }
  /// The same with `first` displaced by `shift`.
  int depth(const Particle& first, const Particle& second, lattice::Axial shift);

 private:
  std::vector<Kind> kinds_;
  lattice::Lattice lattice_;
  std::map<std::pair<std::uint16_t, std::uint16_t>, SeparationTable> tables_;
};

/// The vector between two sites, the shorter way round a periodic box.
lattice::Axial nearest_vector(const lattice::Lattice& lattice, lattice::Site from,
                              lattice::Site to);

}  // namespace clca::grains
