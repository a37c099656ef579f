#include "render/site_lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "clca/parallel/first_failure.hpp"
#include "clca/render/painter.hpp"
#include "render/shade.hpp"
#include "render/wall_appearance.hpp"

namespace clca::render {

namespace {

using grains::Owner;
using lattice::Site;

// All standing walls count as one owner, so that no outlines separate them; so do all moving walls.
constexpr Owner kStandingWall = grains::kBorder;
constexpr Owner kMovingWall = grains::kBorder + 1;  // the code of no wall

/// Owners of the sites of a state, without particles.
class WallSites {
 public:
  WallSites(const grains::State& state, const grains::Occupancy& occupancy)
      : occupancy_(occupancy) {
    for (const grains::Wall& wall : state.walls) {
      moving_.push_back(moves(wall));
    }
  }

  Owner owner(std::size_t index) const {
    const Owner owner = occupancy_.owner(index);
    return grains::is_particle(owner) ? grains::kFree : owner;
  }
  bool any_taken(Site low, Site high) const { return occupancy_.any_taken(low, high); }
  /// The owner that its seams belong to.
  Owner whole(Owner owner) const {
    if (!grains::is_wall(owner) || owner == kMovingWall) {
      return owner;
    }
    const std::size_t wall = grains::wall_number(owner);
    return wall < moving_.size() && moving_[wall] ? kMovingWall : kStandingWall;
  }
  SampleCode code(Owner owner) const {
    return code_of(owner == grains::kFree        ? Background::paper
                   : whole(owner) == kMovingWall ? Background::moving_wall
                                                 : Background::wall);
  }

 private:
  const grains::Occupancy& occupancy_;
  std::vector<bool> moving_;
};

template <class Rule>
class ParticleSites : public WallSites {
 public:
  ParticleSites(const grains::State& state, const grains::Occupancy& occupancy, const Rule& rule,
                std::size_t colors)
      : WallSites(state, occupancy), shading_{state, occupancy}, rule_(rule), colors_(colors) {}

  Owner owner(std::size_t index) const { return shading_.occupancy.owner(index); }
  SampleCode code(Owner owner) const {
    if (!grains::is_particle(owner)) {
      return WallSites::code(owner);
    }
    const std::size_t shade = shading_.shade(rule_, grains::particle_id(owner));
    return code_of(in_palette(shade, colors_), false);
  }

 private:
  Shading shading_;
  const Rule& rule_;
  std::size_t colors_;
};

std::int64_t in_units(double value, int fraction_bits) {
  return static_cast<std::int64_t>(std::floor(std::ldexp(value, fraction_bits)));
}

}  // namespace

/// A vertical block of samples, in arrays for vector instructions.
struct SiteLookup::Block {
  static constexpr std::size_t kMaxSamples = 16;
  template <class T>
  using Each = std::array<T, kMaxSamples>;

  std::size_t count = 0;
  bool uniform = true;  ///< no sample has two owners
  Owner least = 0;
  // Weight of corner a of the lattice triangle (a, b, c) around a sample.
  Each<Owner> a = {}, b = {}, c = {};
  Each<std::int32_t> weight_b = {}, weight_c = {};
  Each<std::int32_t> row = {};
  Each<std::int32_t> upper = {};
  Each<Owner> owner = {};
  Each<std::int32_t> outlined = {};
};

SiteLookup::SiteLookup(const lattice::Lattice& lattice, const Projection& projection, int threads)
    : lattice_(lattice),
      projection_(projection),
      threads_(threads),
      box_(projection.samples_in(whole_box(lattice))),
      // The weight changes by one over the height of a lattice triangle, the column pitch.
      outline_width_(projection.outline_strength > 0
                         ? static_cast<std::int32_t>(in_units(
                               projection.outline_width / lattice::kColumnPitch, kFractionBits))
                         : 0) {
  for (int y = box_.y; y < box_.y + box_.height; ++y) {
    const double height = projection.corner.y() + (y + 0.5) / projection.scale;
    const GridCoordinate coordinate = coordinate_of(in_units(height, kFractionBits));
    rows_.push_back(coordinate.whole);
    parts_.push_back(coordinate.part);
  }
}

SiteLookup::GridCoordinate SiteLookup::coordinate_of(std::int64_t units) {
  return {static_cast<std::int32_t>(units >> kFractionBits),
          static_cast<std::int32_t>(units & (kOne - 1))};
}

SiteLookup::ColumnPair SiteLookup::pair_at(int x) const {
  const double across = projection_.corner.x() + (x + 0.5) / projection_.scale;
  const std::int64_t column = in_units(across / lattice::kColumnPitch, kFractionBits);
  const GridCoordinate coordinate = coordinate_of(column);
  // Border owners extend to infinity: floor and side walls have any thickness.
  const auto in_memory = [this](int wanted) {
    return lattice_.periodic() ? wanted : std::clamp(wanted, -1, lattice_.columns());
  };
  const std::int64_t first_row = coordinate.whole >> 1;  // of the axial height 0
  return {.left = in_memory(coordinate.whole),
          .right = in_memory(coordinate.whole + 1),
          .right_rows_more = lattice::is_odd(coordinate.whole) ? 1 : 0,
          .part = coordinate.part,
          .lift = coordinate_of((first_row << kFractionBits) - (column >> 1))};
}

template <class OwnerAt>
void SiteLookup::take_corners(const ColumnPair& pair, std::size_t first, Block& block,
                              OwnerAt owner_at) const {
#pragma omp simd
  for (std::size_t i = 0; i < block.count; ++i) {
    const std::int32_t part = parts_[first + i] + pair.lift.part;
    const std::int32_t more = part >= kOne ? 1 : 0;
    const std::int32_t up = part - (more << kFractionBits);
    const std::int32_t upper = pair.part + up >= kOne ? 1 : 0;
    block.row[i] = rows_[first + i] + pair.lift.whole + more;
    block.upper[i] = upper;
    block.weight_b[i] = upper != 0 ? kOne - up : pair.part;
    block.weight_c[i] = upper != 0 ? kOne - pair.part : up;
  }
  Owner unlike = 0;
  block.least = 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    // Lower left or upper right corner, right one, the one above.
    const int left_row = block.row[i];
    const int right_row = left_row + pair.right_rows_more;
    const bool upper = block.upper[i] != 0;
    block.a[i] = owner_at(upper, upper ? right_row + 1 : left_row);
    block.b[i] = owner_at(true, right_row);
    block.c[i] = owner_at(false, left_row + 1);
    unlike |= (block.a[i] ^ block.b[i]) | (block.a[i] ^ block.c[i]);
    block.least = std::min({block.least, block.a[i], block.b[i], block.c[i]});
  }
  block.uniform = unlike == 0;
}

/// Finds the owner of at least half of the weight, and whether the edge of its shape is near.
void SiteLookup::decide(Block& block) const {
  constexpr std::int32_t kHalf = kOne / 2;
  const std::int32_t width = outline_width_;
#pragma omp simd
  for (std::size_t i = 0; i < Block::kMaxSamples; ++i) {
    const Owner a = block.a[i];
    const Owner b = block.b[i];
    const Owner c = block.c[i];
    const std::int32_t weight_b = block.weight_b[i];
    const std::int32_t weight_c = block.weight_c[i];
    // Of owners with several corners, the first one speaks for all.
    const std::int32_t of_a =
        kOne - weight_b - weight_c + (b == a ? weight_b : 0) + (c == a ? weight_c : 0);
    const std::int32_t of_b = weight_b + (c == b ? weight_c : 0);
    const Owner b_or_c = of_b >= kHalf ? b : weight_c >= kHalf ? c : grains::kFree;
    const Owner owner = of_a >= kHalf ? a : b_or_c;
    const std::int32_t most = std::max(of_a, std::max(of_b, weight_c));
    block.owner[i] = owner;
    block.outlined[i] =
        static_cast<std::int32_t>(owner >= 0) & static_cast<std::int32_t>(most - kHalf < width);
  }
}

/// `sites` tells the owner of the site with an index, the owner that stands for several, and the
/// code of its samples.
template <class Sites>
void SiteLookup::look_up_column(const Sites& sites, const ColumnPair& pair,
                                const std::vector<bool>& empty, std::span<SampleCode> codes) const {
  Block block;
  Owner last = grains::kFree;
  SampleCode last_code = code_of(Background::paper);
  const auto look_up = [&](std::size_t first, std::size_t end, auto owner_at) {
    for (; first < end; first += block.count) {
      block.count = std::min(Block::kMaxSamples, end - first);
      take_corners(pair, first, block, owner_at);
      if (block.uniform) {
        block.owner = block.a;
        block.outlined.fill(0);
      } else {
        for (std::size_t i = 0; block.least < grains::kFree && i < block.count; ++i) {
          block.a[i] = sites.whole(block.a[i]);
          block.b[i] = sites.whole(block.b[i]);
          block.c[i] = sites.whole(block.c[i]);
        }
        decide(block);
      }
      for (std::size_t i = 0; i < block.count; ++i) {
        if (block.owner[i] != last) {
          last = block.owner[i];
          last_code = sites.code(last);
        }
        codes[first + i] = static_cast<SampleCode>(last_code + block.outlined[i]);
      }
    }
  };
  const auto end_below = [&](int row) {  // of samples
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), row - pair.lift.whole);
    return static_cast<std::size_t>(found - rows_.begin());
  };
  const auto near_border = [&](bool right, int row) {
    const int column = right ? pair.right : pair.left;
    const bool side = !lattice_.periodic() && (column < 0 || column == lattice_.columns());
    const Site site = {column, std::clamp(row, -1, lattice_.rows())};
    return row >= lattice_.rows() && !side ? grains::kFree : sites.owner(lattice_.index(site));
  };
  // Inside the box only owners need to be read.
  const std::size_t floor = end_below(-1);
  const std::size_t lid = std::max(floor, end_below(lattice_.rows() - 2 - pair.right_rows_more));
  const std::size_t left = lattice_.index({pair.left, 0});
  const std::size_t right = lattice_.index({pair.right, 0});
  look_up(0, floor, near_border);
  const auto between = [&](bool on_right, int row) {
    const auto rows = static_cast<std::size_t>(std::ptrdiff_t{row} * lattice::Lattice::kRowPitch);
    return sites.owner((on_right ? right : left) + rows);
  };
  for (std::size_t first = floor; first < lid;) {
    const std::size_t tile = first / kTileHeight;
    const std::size_t end = std::min(lid, (tile + 1) * kTileHeight);
    if (empty[tile]) {
      std::fill_n(codes.begin() + static_cast<std::ptrdiff_t>(first), end - first,
                  code_of(Background::paper));
    } else {
      look_up(first, end, between);
    }
    first = end;
  }
  look_up(lid, rows_.size(), near_border);
}

/// Finds empty tiles with few word reads, for the columns of samples from `first` to `last`, from
/// below.
template <class Sites>
std::vector<bool> SiteLookup::empty_tiles(const Sites& sites, int first, int last) const {
  // Lattice rows of a column are up to one lower than its samples; rows that are read are up to
  // three higher.
  constexpr int kBelow = 1;
  constexpr int kAbove = 3;
  const int left = pair_at(first).left;
  const int right = pair_at(last).right;
  const bool beyond = left < -1 || right > lattice_.columns();  // of a periodic box
  std::vector<bool> empty;
  for (std::size_t tile = 0; tile < rows_.size(); tile += kTileHeight) {
    const int low = std::max(rows_[tile] - kBelow, -1);
    const int high = std::min(rows_[std::min(tile + kTileHeight, rows_.size()) - 1] + kAbove,
                              lattice_.rows() - 1);
    empty.push_back(!beyond && !sites.any_taken({left, low}, {right, high}));
  }
  return empty;
}

template <class Sites>
void SiteLookup::fill(const Sites& sites, SampleGrid& grid) const {
  const auto below = static_cast<std::size_t>(box_.y);
  const std::size_t above = below + rows_.size();
  const auto fill_column = [&](int x, const std::vector<bool>& empty) {
    const std::span<SampleCode> column = grid.column(x);
    std::fill_n(column.begin(), below, code_of(Background::paper));
    look_up_column(sites, pair_at(x), empty, column.subspan(below, rows_.size()));
    std::fill_n(column.begin() + static_cast<std::ptrdiff_t>(above), column.size() - above,
                code_of(Background::paper));
  };
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (int first = 0; first < grid.width(); first += kTileWidth) {
    failure.guard([&] {
      const int end = std::min(first + kTileWidth, grid.width());
      const int from = std::clamp(box_.x, first, end);
      const int to = std::clamp(box_.x + box_.width, from, end);
      const std::vector<bool> empty =
          from < to ? empty_tiles(sites, from, to - 1) : std::vector<bool>();
      for (int x = first; x < end; ++x) {
        if (x >= from && x < to) {
          fill_column(x, empty);
        } else {
          std::fill(grid.column(x).begin(), grid.column(x).end(), code_of(Background::paper));
        }
      }
    });
  }
  failure.rethrow();
}

void SiteLookup::particles(const grains::State& state, const grains::Occupancy& occupancy,
                           const Coloring& coloring, SampleGrid& grid) const {
  std::visit(
      [&](const auto& rule) {
        this->fill(ParticleSites(state, occupancy, rule, coloring.palette.size()), grid);
      },
      coloring.rule);
}

void SiteLookup::walls(const grains::State& state, const grains::Occupancy& occupancy,
                       SampleGrid& grid) const {
  fill(WallSites(state, occupancy), grid);
}

}  // namespace clca::render
