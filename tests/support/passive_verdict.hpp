#pragma once
// The passive rule for one particle and one direction, as plainly as it can be.

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "support/crowd.hpp"

namespace clca::testing {

class Verdict {
 public:
  Verdict(const Crowd& crowd, lattice::Direction gravity, grains::Owner id,
          lattice::Direction direction);

  /// The least is the best; none: it may not go that way.
  std::optional<int> score() const;
  /// The pushes that the move would make.
  std::vector<grains::Push> new_pushes() const;

 private:
  int angle() const;
  int relief(const grains::Push& push) const;
  bool helps_strictly() const;
  bool helps_somehow() const;
  bool has_room() const;
  bool minds_walls() const;
  bool can_leave_then(grains::Owner wall) const;
  bool bearable() const;
  int grown() const;
  int votes() const;

  const Crowd& crowd_;
  lattice::Direction gravity_;
  grains::Owner id_;
  lattice::Direction direction_;
  std::map<grains::Owner, Change> changes_;
  std::vector<grains::Push> pushes_;
  std::set<grains::Owner> deepened_;  // particles
};

}  // namespace clca::testing
