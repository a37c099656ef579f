#pragma once
// The owner of each site, to be read.

#include <memory>
#include <span>

#include "clca/grains/state.hpp"

namespace clca::grains {

class OccupancyTable;

/// The owner of each site, by lattice::Lattice::index. If walls may overlap particles
/// (walls_may_overlap), a site has up to two owners. The occupancy of a model is a live view, as
/// are its copies: none may outlive the model.
class Occupancy {
 public:
  /// The present owners in a state that has no model. Throws std::invalid_argument if a particle
  /// leaves the box or overlaps a wall or particle without a Push, if a site has three owners, if a
  /// moving wall overlaps another wall, or if a kind is as wide as a periodic box.
  explicit Occupancy(const State& state);

  /// Number of indices, as lattice::Lattice::index_count.
  std::size_t index_count() const { return inverted_owners_.size(); }
  /// The first owner: walls come before particles, lower ids before higher ones.
  Owner owner(std::size_t index) const { return ~inverted_owners_[index]; }
  /// Bitwise complements of the first owners.
  std::span<const Owner> inverted_owners() const { return inverted_owners_; }
  /// kFree if there is none.
  Owner second_owner(std::size_t index) const {
    return second_owners_.empty() ? kFree : second_owners_[index];
  }
  bool is_taken(std::size_t index) const { return owner(index) != kFree; }
  /// Whether `owner` is one of the owners.
  bool has_owner(std::size_t index, Owner owner) const {
    return this->owner(index) == owner || second_owner(index) == owner;
  }

  /// Equal if all owners are equal.
  bool operator==(const Occupancy& other) const;

 private:
  friend class OccupancyTable;

  Occupancy() = default;

  std::shared_ptr<const OccupancyTable> table_;  // null for the occupancy of a model
  // Both lie in the table:
  std::span<Owner> inverted_owners_;
  std::span<Owner> second_owners_;  // empty if nothing may overlap
};

}  // namespace clca::grains
