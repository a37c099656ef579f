#pragma once
// What regions are filled with, and what comes of it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace clca::grains {

/// Species in fixed proportions by number, without an end of their own: a region is filled until
/// the next particle drawn has no room, or up to a level. A picture divides the region into parts
/// with proportions of their own; a particle belongs to the part that its reference site lies in.
struct Mixture {
  /// Of each part: weights by species, one for each, not all zero.
  std::vector<std::vector<std::uint32_t>> parts = {};
  /// Pixels that cover the region, from the top: kFirstPart is the first part, and so on; others
  /// stay empty. None: the first part is everywhere.
  std::vector<std::string> rows = {};
  bool deposited = false;  ///< a packing at rest, in place of particles at random
  /// Ends the deposition where the surface reaches this mean height, in lattice spacings.
  std::optional<double> level = {};

  static constexpr char kFirstPart = 'A';
};

/// Bytes for the positions that a fill at random tries: of these sites, each in so many
/// orientations.
double trial_bytes(double sites, double orientations);

/// How many particles a fill has placed.
struct FillResult {
  std::vector<std::size_t> placed;  ///< per species
  bool complete = true;
};

}  // namespace clca::grains
