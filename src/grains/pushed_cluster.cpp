#include "grains/internal/pushed_cluster.hpp"

namespace clca::grains {

void PushedCluster::add_owners(std::size_t index) {
  add(box_.occupancy.owner(index));
  add(box_.occupancy.second_owner(index));
}

void PushedCluster::add(Owner owner) {
  if (is_particle(owner)) {
    const auto id = particle_id(owner);
    if (!included_[id]) {
      included_[id] = true;
      ids_.push_back(id);
    }
  } else {
    blocked_ = blocked_ || (owner != kFree && owner != wall_code(step_.wall));
  }
}

}  // namespace clca::grains
