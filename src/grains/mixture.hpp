#pragma once
// The parts of a region that is filled with a mixture.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "clca/grains/fill.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/picture.hpp"
#include "clca/lattice/region.hpp"
#include "grains/internal/box.hpp"

namespace clca::grains {

struct Parts {
  std::vector<std::vector<std::size_t>> weights;  ///< by species, one for each
  std::optional<lattice::Picture> picture;

  /// None where the picture is empty.
  std::optional<std::size_t> part_at(lattice::Site site) const {
    if (!picture) {
      return 0;
    }
    const auto part = static_cast<std::size_t>(
        lattice::pixel_at(*picture, lattice::position(site)) - Mixture::kFirstPart);
    return part < weights.size() ? std::optional(part) : std::nullopt;
  }
};

/// See fill_with.
FillResult deposit_mixture(Box& box, const lattice::Rectangle& region, const Parts& parts,
                           std::optional<double> level);

}  // namespace clca::grains
