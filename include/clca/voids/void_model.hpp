#pragma once
// Voids that rise through grains of one site (Litwiniszyn 1958, Mullins 1972, Caram & Hong 1991).

#include <vector>

#include "clca/grains/model.hpp"

namespace clca::voids {

using grains::Options;

struct Rules {
  /// Weight of the grain straight above a void, in [0, 1]; the two beside it share the rest.
  double straight_weight = 1.0 / 3;
  /// Factor of the weights of the grains, by species, in [0, 1]. Empty: 1 for all.
  std::vector<double> sieve_factors = {};

  bool operator==(const Rules&) const = default;
};

class VoidModel : public grains::Model {
 public:
  /// Throws std::invalid_argument if the state is not valid (see grains::check_valid,
  /// grains::check_one_site, grains::Occupancy), a weight is out of range, a species has none, or
  /// the number of threads is not positive.
  explicit VoidModel(grains::State state, const Rules& rules = {}, const Options& options = {});

  const grains::State& state() const { return grains(); }
};

}  // namespace clca::voids
