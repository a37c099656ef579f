#include "grains/internal/separation.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace clca::grains {

namespace {

using lattice::Axial;

constexpr std::uint16_t kUnknown = 0xffff;

}  // namespace

// The shapes overlap where `apart` is a difference a - b of a site of the first and one of the
// second.
// The table has a rim of positions without overlap, from which distances spread.
SeparationTable::SeparationTable(const lattice::Shape& first, const lattice::Shape& second)
    : depths_(first, second, 0) {
  for (const Axial a : first.sites()) {
    for (const Axial b : second.sites()) {
      *depths_.find(a - b) = kUnknown;
    }
  }
  std::deque<Axial> front;
  depths_.for_each([&](Axial apart) {
    if (*depths_.find(apart) == 0) {
      front.push_back(apart);
    }
  });
  for (; !front.empty(); front.pop_front()) {
    const std::uint16_t depth = *depths_.find(front.front());
    for (const lattice::Direction direction : lattice::kDirections) {
      const Axial next = front.front() + unit(direction);
      if (std::uint16_t* found = depths_.find(next); found != nullptr && *found == kUnknown) {
        *found = static_cast<std::uint16_t>(depth + 1);
        front.push_back(next);
      }
    }
  }
}

int SeparationTable::depth(Axial apart) const {
  const std::uint16_t* found = depths_.find(apart);
  return found != nullptr ? *found : 0;
}

int SeparationTable::depth(Axial apart, int columns) const {
  if (columns < 2 || columns % 2 != 0) {
    throw std::invalid_argument("a periodic box has a positive, even number of columns");
  }
  // Once around the box: up the columns, then down by half as many sites, to the same row.
  const Axial round{columns, -columns / 2};
  while (apart.x - columns >= depths_.low_column()) {
    apart = apart - round;
  }
  while (apart.x < depths_.low_column()) {
    apart = apart + round;
  }
  int deepest = 0;
  for (; apart.x < depths_.end_column(); apart = apart + round) {
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
