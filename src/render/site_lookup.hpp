#pragma once
// Draws the owner of the sites around every sample. Integer arithmetic: the same picture
// everywhere. The cost is per sample: if there are many sites per sample, most are not read.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/coloring.hpp"
#include "render/layout.hpp"
#include "render/samples.hpp"

namespace clca::render {

/// Whether the wall is present and has a motion; such walls have another colour.
inline bool is_moving_wall(const grains::Wall& wall) {
  return wall.present && wall.motion.has_value();
}

class SiteLookup {
 public:
  /// `samples` a pixel along each axis. `threads`: that share a picture.
  SiteLookup(const lattice::Lattice& lattice, const Projection& projection, int samples,
             int threads);

  /// Walls, floor, side walls and particles with their outlines.
  /// Only what has changed since the last picture is drawn anew.
  Image picture(const grains::State& state, const grains::Occupancy& occupancy,
                const Coloring& coloring);

 private:
  /// Fractions of a column or spacing, and weights, in units of 1/2^kFractionBits.
  static constexpr int kFractionBits = 30;
  static constexpr std::int32_t kOne = std::int32_t{1} << kFractionBits;
  static constexpr std::int32_t kHalf = kOne / 2;

  /// Height of a row of samples: the row of sites below it in even columns, and the fraction above.
  struct Height {
    int row = 0;
    std::int32_t fraction = 0;
  };
  class Colors;

  grains::Owner owner_near_border(const grains::Occupancy& occupancy, int column, int row) const;
  template <bool kNearBorder>
  void draw_samples(const Colors& colors, const Height& height,
                    std::span<const std::uint8_t> changed, Sample* samples) const;
  std::vector<std::uint8_t> changed_blocks(const grains::Occupancy& occupancy, int first,
                                           int last) const;
  bool near_border(const Height& height) const {
    return height.row < 1 || height.row > lattice_.rows() - 4;
  }

  lattice::Lattice lattice_;
  Projection projection_;
  int samples_;
  int threads_;
  PixelBox box_;
  // By column of samples in box_: the lattice columns around it, whether the left one is odd (-1 or
  // 0), the fraction of the way between them, and the indices of their sites in row 0.
  std::vector<std::array<int, 2>> columns_;
  std::vector<std::int32_t> odd_;
  std::vector<std::int32_t> fractions_;
  std::vector<std::int32_t> left_;   // from that of the first column of the block
  std::vector<std::int32_t> right_;  // in the axial row of the left one
  std::vector<Height> heights_;      // by row of samples in box_
  std::int32_t outline_width_;       // in barycentric weight, as kOne
  struct BlockSpan {
    std::size_t begin = 0;  // in columns_
    std::size_t end = 0;
  };
  std::vector<BlockSpan> blocks_;
  // The last picture: its colours, owners by site, and pixels.
  std::vector<Sample> colors_;
  std::vector<grains::Owner> owners_;
  Image picture_;
};

}  // namespace clca::render
