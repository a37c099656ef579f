#pragma once
// Finds for every sample who owns the sites around it. The work is that of the samples: where many
// sites lie between two of them, most are not looked at.

#include <cstdint>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/render/coloring.hpp"
#include "render/projection.hpp"
#include "render/sample_grid.hpp"

namespace clca::render {

/// For one view of one lattice, in grids of its samples. Counts in whole numbers, so that the
/// result is the same everywhere.
class SiteLookup {
 public:
  /// `threads` share the work of a picture.
  SiteLookup(const lattice::Lattice& lattice, const Projection& projection, int threads);

  /// Walls, floor and side walls, and the shades of particles with their outlines.
  void particles(const grains::State& state, const grains::Occupancy& occupancy,
                 const Coloring& coloring, SampleGrid& grid) const;
  /// The same without particles.
  void walls(const grains::State& state, const grains::Occupancy& occupancy,
             SampleGrid& grid) const;

 private:
  /// Parts of a column or a spacing, and weights, in units of 1/2^kFractionBits.
  static constexpr int kFractionBits = 30;
  static constexpr std::int32_t kOne = std::int32_t{1} << kFractionBits;
  // Samples of a tile.
  static constexpr int kTileWidth = 16;
  static constexpr std::size_t kTileHeight = 64;

  /// A place along an axis, at `part` of the way from a number to the next.
  struct Place {
    std::int32_t whole = 0;
    std::int32_t part = 0;
  };
  /// The two lattice columns about a column of samples, in memory.
  struct Pair {
    int left = 0;
    int right = 0;
    int right_rows_more = 0;  ///< by which rows at the same axial height differ on the right
    std::int32_t part = 0;    ///< of the way from left to right
    Place lift;               ///< from the height of a sample to its row on the left
  };
  struct Block;

  static Place place_of(std::int64_t units);
  Pair pair_at(int x) const;
  template <class Sites>
  void fill(const Sites& sites, SampleGrid& grid) const;
  template <class Sites>
  std::vector<bool> empty_tiles(const Sites& sites, int first, int last) const;
  template <class Sites>
  void look_up_column(const Sites& sites, const Pair& pair, const std::vector<bool>& empty,
                      std::span<SampleCode> codes) const;
  template <class OwnerAt>
  void take_corners(const Pair& pair, std::size_t first, Block& block, OwnerAt owner_at) const;
  void decide(Block& block) const;

  lattice::Lattice lattice_;
  Projection projection_;
  int threads_;
  SampleBox box_;
  // Heights of the rows of samples in box_.
  std::vector<std::int32_t> rows_;
  std::vector<std::int32_t> parts_;
  std::int32_t outline_width_;  // in weight
};

}  // namespace clca::render
