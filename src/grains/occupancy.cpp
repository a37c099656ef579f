#include "clca/grains/occupancy.hpp"

#include <algorithm>
#include <utility>

#include "grains/internal/occupancy_table.hpp"

namespace clca::grains {

Occupancy::Occupancy(std::shared_ptr<const OccupancyTable> table)
    : table_(std::move(table)),
      inverted_owners_(table_->inverted_owners()),
      second_owners_(table_->second_owners()) {}

Occupancy::Occupancy(const State& state)
    : Occupancy(std::make_shared<const OccupancyTable>(state)) {}

Occupancy::Occupancy(const OccupancyTable& table)
    : Occupancy(std::shared_ptr<const OccupancyTable>(std::shared_ptr<void>(), &table)) {}

bool Occupancy::any_taken(lattice::Site low, lattice::Site high) const {
  return table_->any_taken(low, high);
}

bool Occupancy::operator==(const Occupancy& other) const {
  return std::ranges::equal(inverted_owners_, other.inverted_owners_) &&
         std::ranges::equal(second_owners_, other.second_owners_);
}

}  // namespace clca::grains
