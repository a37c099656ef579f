#include "render/site_lookup.hpp"

#include <algorithm>
#include <cmath>

#include "clca/parallel/team.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

using grains::Owner;

// All standing walls count as one owner, so that no outlines separate them; so do all moving walls.
constexpr Owner kStandingWall = grains::kFree - 1;
constexpr Owner kMovingWall = grains::kFree - 2;
constexpr std::size_t kOthers = 3;  // owners that are no particles: these and kFree

constexpr Sample kPackedPaper = to_sample(kPaper);

std::int64_t in_units(double value, int fraction_bits) {
  return static_cast<std::int64_t>(std::floor(std::ldexp(value, fraction_bits)));
}

}  // namespace

class SiteLookup::Colors {
 public:
  Colors(const grains::State& state, const grains::Occupancy& occupancy, const Coloring& coloring,
         double outline_strength)
      : occupancy_(occupancy), colors_(2 * (state.particles.size() + kOthers)) {
    for (const grains::Wall& wall : state.walls) {
      moving_.push_back(is_moving_wall(wall));
    }
    const auto set = [this](Owner owner, Rgb fill, Rgb outline) {
      colors_[color_index(owner)] = to_sample(fill);
      colors_[color_index(owner) + 1] = to_sample(outline);
    };
    set(grains::kFree, kPaper, kPaper);
    for (const bool moving : moving_) {  // so that the table tells of it
      colors_.push_back(moving ? 1 : 0);
    }
    set(kStandingWall, kWallColor, kWallColor);
    set(kMovingWall, kMovingWallColor, kMovingWallColor);
    std::vector<Rgb> outlines;
    for (const Rgb fill : coloring.palette) {
      outlines.push_back(outline_color(fill, outline_strength));
    }
    for (std::size_t id = 0; id < state.particles.size(); ++id) {
      if (state.particles[id].present) {
        const std::size_t shade = coloring.palette_indices[id];
        set(static_cast<Owner>(id), coloring.palette[shade], outlines[shade]);
      }
    }
  }

  const grains::Occupancy& occupancy() const { return occupancy_; }
  /// The owner that it counts as: all standing walls are one, all moving ones another.
  Owner merged_owner(Owner owner) const {
    if (owner >= grains::kFree) {
      return owner;
    }
    const std::size_t wall = grains::wall_number(owner);
    return wall < moving_.size() && moving_[wall] ? kMovingWall : kStandingWall;
  }
  /// Index into table() of the fill of a merged_owner(); that of its outline follows.
  static constexpr std::size_t color_index(Owner owner) {
    return 2 * static_cast<std::size_t>(owner + static_cast<Owner>(kOthers));
  }
  const std::vector<Sample>& table() const { return colors_; }
  const Sample* data() const { return colors_.data(); }
  /// All owners below it are standing walls.
  Owner least() const {
    return std::ranges::find(moving_, true) == moving_.end() ? kStandingWall : grains::kBorder;
  }

 private:
  const grains::Occupancy& occupancy_;
  std::vector<bool> moving_;
  std::vector<Sample> colors_;
};

namespace {

// Without branches, for vector instructions.
constexpr std::int32_t mask(bool condition) {
  return -static_cast<std::int32_t>(condition);
}
constexpr std::int32_t chosen(std::int32_t mask, std::int32_t yes, std::int32_t no) {
  return no ^ ((yes ^ no) & mask);
}

/// Rows of the two kinds of columns in a row of samples.
struct Rows {
  // How far it is above even_row and odd_row at the left column; 2^30 is a spacing.
  std::int32_t even_fraction = 0, odd_fraction = 0;
  std::int32_t even_row = 0, odd_row = 0;
};

/// Samples side by side, in arrays for vector instructions.
struct Block {
  static constexpr std::size_t kSize = 48;  // a multiple of all numbers of samples in a pixel
  template <class T>
  using Each = std::array<T, kSize>;

  // Weights of the corners b and c of the lattice triangle (a, b, c) around a sample.
  Each<std::int32_t> weight_b, weight_c;
  Each<Owner> a, b, c;
  Each<std::int32_t> color_index;
};

/// `owner_at(i, right, row)`: of the site on that side of a sample, by the row of its left column;
/// `odd`, `fractions`: as in SiteLookup. Returns 0 if the corners of each sample have one owner.
template <class OwnerAt>
Owner take_corners(Block& block, std::size_t count, const Rows& rows, const std::int32_t* odd,
                   const std::int32_t* fractions, Owner least, OwnerAt owner_at) {
  constexpr std::int32_t kOne = std::int32_t{1} << 30;
  const std::int32_t even_fraction = rows.even_fraction;
  const std::int32_t other_fraction = rows.even_fraction ^ rows.odd_fraction;
  const std::int32_t even_row = rows.even_row;
  const std::int32_t other_row = rows.even_row ^ rows.odd_row;
  Owner unlike = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t fraction = fractions[i];
    const std::int32_t above = (even_fraction ^ (other_fraction & odd[i])) - (fraction >> 1);
    const std::int32_t below = above >> 31;  // -1 or 0
    const std::int32_t up = above + (kOne & below);
    const std::int32_t row = (even_row ^ (other_row & odd[i])) + below;
    const bool upper = fraction + up >= kOne;
    block.weight_b[i] = upper ? kOne - up : fraction;
    block.weight_c[i] = upper ? kOne - fraction : up;
    const Owner a = std::max(owner_at(i, upper, row + (upper ? 1 : 0)), least);
    const Owner b = std::max(owner_at(i, true, row), least);
    const Owner c = std::max(owner_at(i, false, row + 1), least);
    unlike |= (a ^ b) | (a ^ c);
    block.a[i] = a;
    block.b[i] = b;
    block.c[i] = c;
  }
  return unlike;
}

/// Finds the owner of at least half of the weight, and whether the edge of its shape is near; puts
/// the index of its colour, or of that of its outline, into the block.
void find_colors(Block& block, std::size_t count, std::int32_t width) {
  constexpr std::int32_t kOne = std::int32_t{1} << 30;
  constexpr std::int32_t kHalf = kOne / 2;
  for (std::size_t i = 0; i < count; ++i) {
    const Owner a = block.a[i];
    const Owner b = block.b[i];
    const Owner c = block.c[i];
    const std::int32_t weight_b = block.weight_b[i];
    const std::int32_t weight_c = block.weight_c[i];
    // Of owners with several corners, the first one speaks for all.
    const std::int32_t of_a =
        kOne - weight_b - weight_c + (weight_b & mask(b == a)) + (weight_c & mask(c == a));
    const std::int32_t of_b = weight_b + (weight_c & mask(c == b));
    const Owner c_or_none = c | mask(weight_c < kHalf);  // kFree has all bits
    const Owner b_or_c = chosen(mask(of_b >= kHalf), b, c_or_none);
    const Owner owner = chosen(mask(of_a >= kHalf), a, b_or_c);
    const std::int32_t most = std::max(of_a, std::max(of_b, weight_c));
    const std::int32_t line = mask(most - kHalf < width) & 1;
    block.color_index[i] = 2 * (owner + static_cast<Owner>(kOthers)) + line;
  }
}

}  // namespace

SiteLookup::SiteLookup(const lattice::Lattice& lattice, const Projection& projection, int samples,
                       int threads)
    : lattice_(lattice),
      projection_(projection),
      samples_(samples),
      threads_(threads),
      box_(projection.samples_in(box_with_frame(lattice))),
      // The weight changes by one over the height of a lattice triangle, the column pitch.
      outline_width_(projection.outline_strength > 0
                         ? static_cast<std::int32_t>(in_units(
                               projection.outline_width / lattice::kColumnPitch, kFractionBits))
                         : 0) {
  for (int y = box_.y; y < box_.y + box_.height; ++y) {
    const double height = projection.corner.y() + (y + 0.5) / projection.samples_per_spacing;
    const std::int64_t units = in_units(height, kFractionBits);
    heights_.push_back(
        {static_cast<int>(units >> kFractionBits), static_cast<std::int32_t>(units & (kOne - 1))});
  }
  // Border owners extend to infinity: floor and side walls have any thickness.
  const auto in_memory = [&](int wanted) {
    return lattice.periodic() ? wanted : std::clamp(wanted, -1, lattice.columns());
  };
  for (int x = box_.x; x < box_.x + box_.width; ++x) {
    const double across = projection.corner.x() + (x + 0.5) / projection.samples_per_spacing;
    const std::int64_t units = in_units(across / lattice::kColumnPitch, kFractionBits);
    const auto column = static_cast<int>(units >> kFractionBits);
    const int rows_more = lattice::is_odd(column) ? 1 : 0;  // on the right, at the same height
    columns_.push_back({in_memory(column), in_memory(column + 1)});
    odd_.push_back(-rows_more);
    fractions_.push_back(static_cast<std::int32_t>(units & (kOne - 1)));
    const std::size_t here = columns_.size() - 1;
    if (blocks_.empty() || static_cast<std::size_t>(x) % Block::kSize == 0) {
      blocks_.push_back({here, here});
    }
    blocks_.back().end = here + 1;
    const std::size_t block = blocks_.back().begin;
    const auto from_block = [&](lattice::Site site) {
      return static_cast<std::int32_t>(
          static_cast<std::ptrdiff_t>(lattice.index(site)) -
          static_cast<std::ptrdiff_t>(lattice.index({columns_[block][0], 0})));
    };
    left_.push_back(from_block({columns_.back()[0], 0}));
    right_.push_back(from_block({columns_.back()[1], rows_more}));
  }
}

/// Finds blocks whose sites have changed in the rows of samples from `first` to `last`.
std::vector<std::uint8_t> SiteLookup::changed_blocks(const grains::Occupancy& occupancy, int first,
                                                     int last) const {
  const auto row = [&](int y) { return heights_[static_cast<std::size_t>(y - box_.y)].row; };
  const int low = std::clamp(row(first) - 2, -1, lattice_.rows());
  const int high = std::clamp(row(last) + 2, -1, lattice_.rows());
  const Owner* now = occupancy.inverted_owners().data();
  std::vector<std::uint8_t> changed;
  for (const BlockSpan& block : blocks_) {
    bool same = !owners_.empty();
    const int left = columns_[block.begin][0];
    const int right = columns_[block.end - 1][1];
    const int columns = left <= right ? right - left : right - left + lattice_.columns();
    for (int column = left; same && column <= left + columns + 1; ++column) {
      const int there = lattice_.periodic() ? column : std::min(column, lattice_.columns());
      // Two columns are interleaved.
      const std::size_t from = lattice_.index({there, low}) / 2 * 2;
      const std::size_t to = lattice_.index({there, high}) / 2 * 2 + 2;
      same = std::equal(now + from, now + to, owners_.data() + from);
    }
    changed.push_back(same ? 0 : 1);
  }
  return changed;
}

/// The border is everywhere below the box and beside it; above it there is none.
Owner SiteLookup::owner_near_border(const grains::Occupancy& occupancy, int column, int row) const {
  const bool outside = !lattice_.periodic() && (column < 0 || column == lattice_.columns());
  return row >= lattice_.rows() && !outside
             ? grains::kFree
             : occupancy.owner(lattice_.index({column, std::clamp(row, -1, lattice_.rows())}));
}

template <bool kNearBorder>
void SiteLookup::draw_samples(const Colors& colors, const Height& height,
                              std::span<const std::uint8_t> changed, Sample* samples) const {
  // Sites of odd columns lie half a spacing higher.
  const bool below = height.fraction < kHalf;
  const Rows rows = {.even_fraction = height.fraction,
                     .odd_fraction = height.fraction + (below ? kHalf : -kHalf),
                     .even_row = height.row,
                     .odd_row = height.row - (below ? 1 : 0)};
  const grains::Occupancy& occupancy = colors.occupancy();
  const Sample* table = colors.data();
  const Owner least = colors.least();
  Block block = {};
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    const std::size_t begin = blocks_[number].begin;
    const std::size_t count = blocks_[number].end - begin;
    Sample* drawn = samples + static_cast<std::size_t>(box_.x) + begin;
    if (changed[number] == 0) {
      continue;
    }
    const Owner* inverted =
        occupancy.inverted_owners().data() + lattice_.index({columns_[begin][0], 0});
    const std::int32_t* left = left_.data() + begin;
    const std::int32_t* right = right_.data() + begin;
    const auto owner_at = [&](std::size_t i, bool is_right, std::int32_t row) {
      if constexpr (kNearBorder) {
        const std::size_t x = begin + i;
        return this->owner_near_border(occupancy, columns_[x][is_right ? 1 : 0],
                                       row - (is_right ? odd_[x] : 0));
      }
      return ~inverted[(is_right ? right[i] : left[i]) + lattice::Lattice::kRowStride * row];
    };
    const Owner unlike = take_corners(block, count, rows, odd_.data() + begin,
                                      fractions_.data() + begin, least, owner_at);
    if (unlike == 0 &&
        std::all_of(block.a.begin(), block.a.begin() + static_cast<std::ptrdiff_t>(count),
                    [&](Owner owner) { return owner == block.a[0]; })) {
      std::fill_n(drawn, count,
                  colors.data()[Colors::color_index(colors.merged_owner(block.a[0]))]);
      continue;
    }
    if (least < kStandingWall) {
      for (std::size_t i = 0; i < count; ++i) {
        block.a[i] = colors.merged_owner(block.a[i]);
        block.b[i] = colors.merged_owner(block.b[i]);
        block.c[i] = colors.merged_owner(block.c[i]);
      }
    }
    find_colors(block, count, outline_width_);
    for (std::size_t i = 0; i < count; ++i) {
      drawn[i] = table[block.color_index[i]];
    }
  }
}

Image SiteLookup::picture(const grains::State& state, const grains::Occupancy& occupancy,
                          const Coloring& coloring) {
  const Colors colors(state, occupancy, coloring, projection_.outline_strength);
  const auto pitch = static_cast<std::size_t>(projection_.width);
  if (colors.table() != colors_) {
    colors_ = colors.table();
    owners_.clear();
    picture_ = Image(projection_.width / samples_, projection_.height / samples_, kPaper);
  }
  Image& image = picture_;
  constexpr int kRows = 16;  // of pixels
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
  for (int first = 0; first < image.height; first += kRows) {
    failure.guard([&] {
      const int end = std::min(first + kRows, image.height);
      const int low = std::max(first * samples_, box_.y);
      const int high = std::min(end * samples_, box_.y + box_.height) - 1;
      if (low > high || columns_.empty()) {
        return;
      }
      const std::vector<std::uint8_t> changed = changed_blocks(occupancy, low, high);
      if (std::ranges::find(changed, 1) == changed.end()) {
        return;
      }
      std::vector<Sample> samples(pitch * static_cast<std::size_t>(samples_), kPackedPaper);
      for (int row = first; row < end; ++row) {
        for (int i = 0; i < samples_; ++i) {
          const int y = row * samples_ + i;
          Sample* line = samples.data() + pitch * static_cast<std::size_t>(i);
          if (y < low || y > high) {
            std::fill_n(line, pitch, kPackedPaper);
            continue;
          }
          const Height& height = heights_[static_cast<std::size_t>(y - box_.y)];
          if (near_border(height)) {
            draw_samples<true>(colors, height, changed, line);
          } else {
            draw_samples<false>(colors, height, changed, line);
          }
        }
        for (std::size_t number = 0; number < blocks_.size(); ++number) {
          if (changed[number] == 0) {
            continue;
          }
          const int per = static_cast<int>(Block::kSize) / samples_;
          const int left = (box_.x + static_cast<int>(blocks_[number].begin)) /
                           static_cast<int>(Block::kSize) * per;
          const int count = std::min(per, image.width - left);
          const std::span<Rgb> pixels(&image.at(left, image.height - 1 - row),
                                      static_cast<std::size_t>(count));
          const Sample* from = samples.data() + std::ptrdiff_t{left} * samples_;
          set_to_sample_means(pixels, from, pitch, samples_);
        }
      }
    });
  }
  failure.rethrow();
  const auto now = occupancy.inverted_owners();
  if (now.size() <= image.pixels.size()) {  // otherwise nearly all changes from picture to picture
    owners_.assign(now.begin(), now.end());
  }
  return image;
}

}  // namespace clca::render
