#include "grains/internal/separation.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace clca::grains {

namespace {

using lattice::Axial;

struct Extent {
  Axial low;
  Axial high;
};

Extent extent_of(const lattice::Shape& shape) {
  Extent extent{shape.sites().front(), shape.sites().front()};
  for (const Axial site : shape.sites()) {
    extent.low = {std::min(extent.low.x, site.x), std::min(extent.low.q, site.q)};
    extent.high = {std::max(extent.high.x, site.x), std::max(extent.high.q, site.q)};
  }
  return extent;
}

}  // namespace

// The shapes overlap where `apart` is a difference a - b of a site of the first and one of the
// second.
// The table has a rim of positions without overlap, from which distances spread.
SeparationTable::SeparationTable(const lattice::Shape& first, const lattice::Shape& second) {
  const Extent one = extent_of(first);
  const Extent other = extent_of(second);
  low_ = one.low - other.high - Axial{1, 1};
  const Axial high = one.high - other.low + Axial{1, 1};
  columns_ = high.x - low_.x + 1;
  rows_ = high.q - low_.q + 1;
  constexpr std::uint16_t kUnknown = 0xffff;
  depths_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (const Axial a : first.sites()) {
    for (const Axial b : second.sites()) {
      depths_[place(a - b)] = kUnknown;
    }
  }
  std::deque<Axial> front;
  for (int x = 0; x < columns_; ++x) {
    for (int q = 0; q < rows_; ++q) {
      const Axial apart = low_ + Axial{x, q};
      if (depths_[place(apart)] == 0) {
        front.push_back(apart);
      }
    }
  }
  for (; !front.empty(); front.pop_front()) {
    for (const lattice::Direction direction : lattice::kDirections) {
      const Axial next = front.front() + unit(direction);
      const Axial from_low = next - low_;
      const bool inside =
          from_low.x >= 0 && from_low.x < columns_ && from_low.q >= 0 && from_low.q < rows_;
      if (inside && depths_[place(next)] == kUnknown) {
        depths_[place(next)] = static_cast<std::uint16_t>(depths_[place(front.front())] + 1);
        front.push_back(next);
      }
    }
  }
}

std::size_t SeparationTable::place(Axial apart) const {
  return static_cast<std::size_t>(apart.x - low_.x) * static_cast<std::size_t>(rows_) +
         static_cast<std::size_t>(apart.q - low_.q);
}

int SeparationTable::depth(Axial apart) const {
  const Axial from_low = apart - low_;
  if (from_low.x < 0 || from_low.x >= columns_ || from_low.q < 0 || from_low.q >= rows_) {
    return 0;
  }
  return depths_[place(apart)];
}

int SeparationTable::depth(Axial apart, int columns) const {
  if (columns < 2 || columns % 2 != 0) {
    throw std::invalid_argument("a periodic box has a positive, even number of columns");
  }
  // Once around the box: up the columns, then down by half as many sites, to the same row.
  const Axial round{columns, -columns / 2};
  while (apart.x - columns >= low_.x) {
    apart = apart - round;
  }
  while (apart.x < low_.x) {
    apart = apart + round;
  }
  int deepest = 0;
  for (; apart.x < low_.x + columns_; apart = apart + round) {
    deepest = std::max(deepest, depth(apart));
  }
  return deepest;
}

int Separation::depth(const Particle& first, const Particle& second, Axial shift) {
  const auto key = std::pair(first.kind, second.kind);
  auto found = tables_.find(key);
  if (found == tables_.end()) {
    found =
        tables_.emplace(key, SeparationTable(kinds_[first.kind].shape, kinds_[second.kind].shape))
            .first;
  }
  const Axial apart = nearest_vector(lattice_, first.site(), second.site()) - shift;
  return lattice_.periodic() ? found->second.depth(apart, lattice_.columns())
                             : found->second.depth(apart);
}

Axial nearest_vector(const lattice::Lattice& lattice, lattice::Site from, lattice::Site to) {
  if (lattice.periodic()) {
    const int columns = lattice.columns();
    const int apart = lattice.wrapped(to.column - from.column);
    to.column = from.column + (2 * apart > columns ? apart - columns : apart);
  }
  return to - from;
}

}  // namespace clca::grains
