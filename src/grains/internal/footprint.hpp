#pragma once
// The sites that each kind of particle covers, enters and leaves, as index offsets on one lattice.

#include <array>
#include <cstdint>
#include <vector>

#include "clca/grains/state.hpp"

namespace clca::grains {

/// The sites of one kind, for reference columns of one parity.
struct Footprint {
  template <class T>
  using PerDirection = std::array<std::vector<T>, lattice::kDirectionCount>;

  std::vector<lattice::Offset> body;
  PerDirection<lattice::Offset> lead;
  PerDirection<lattice::Offset> trail;
  std::vector<lattice::Offset> ring;  ///< all sites beside it, each once
};

/// Index offsets of sites that are given from a reference site in a column of this parity.
std::vector<lattice::Offset> offsets(const lattice::Lattice& lattice,
                                     const std::vector<lattice::Axial>& sites, bool odd_column);

class FootprintTable {
 public:
  explicit FootprintTable(const State& state);

  const Footprint& of(const Particle& particle) const { return of(particle.kind, particle.column); }
  const Footprint& of(std::uint16_t kind, int column) const {
    return table_[2U * kind + static_cast<unsigned>(column & 1)];
  }

 private:
  std::vector<Footprint> table_;
};

}  // namespace clca::grains
