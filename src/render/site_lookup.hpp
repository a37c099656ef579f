#pragma once
// Finds the owner of the sites around every sample. The cost is per sample: if there are many sites
// per sample, most are not read.

#include <cstdint>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/render/coloring.hpp"
#include "render/projection.hpp"
#include "render/sample_grid.hpp"

namespace clca::render {

/// For one view of one lattice. Integer arithmetic: the same result everywhere.
class SiteLookup {
 public:
  /// `threads`: number of threads that fill a grid.
  SiteLookup(const lattice::Lattice& lattice, const Projection& projection, int threads);

  /// Fills the grid with walls, floor, side walls and the shades and outlines of particles.
  void particles(const grains::State& state, const grains::Occupancy& occupancy,
                 const Coloring& coloring, SampleGrid& grid) const;
  /// The same without particles.
  void walls(const grains::State& state, const grains::Occupancy& occupancy,
             SampleGrid& grid) const;

 private:
  /// Fractions of a column or spacing, and weights, in units of 1/2^kFractionBits.
  static constexpr int kFractionBits = 30;
  static constexpr std::int32_t kOne = std::int32_t{1} << kFractionBits;
  // Samples of a tile.
  static constexpr int kTileWidth = 16;
  static constexpr std::size_t kTileHeight = 64;

  /// A coordinate along an axis: `whole` plus the fraction `part`.
  struct GridCoordinate {
    std::int32_t whole = 0;
    std::int32_t part = 0;
  };
  /// The two lattice columns around a column of samples.
  struct ColumnPair {
    int left = 0;
    int right = 0;
    int right_rows_more = 0;  ///< by which rows at the same axial height differ on the right
    std::int32_t part = 0;    ///< of the way from left to right
    GridCoordinate lift;      ///< from the height of a sample to its row on the left
  };
  struct Block;

  static GridCoordinate coordinate_of(std::int64_t units);
  ColumnPair pair_at(int x) const;
  template <class Sites>
  void fill(const Sites& sites, SampleGrid& grid) const;
  template <class Sites>
  std::vector<bool> empty_tiles(const Sites& sites, int first, int last) const;
  template <class Sites>
  void look_up_column(const Sites& sites, const ColumnPair& pair, const std::vector<bool>& empty,
                      std::span<SampleCode> codes) const;
  template <class OwnerAt>
  void take_corners(const ColumnPair& pair, std::size_t first, Block& block,
                    OwnerAt owner_at) const;
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
