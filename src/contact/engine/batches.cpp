#include "contact/engine/batches.hpp"

#include <algorithm>

namespace clca::contact {

std::int32_t Batches::body(grains::Owner owner) const {
  if (grains::is_particle(owner)) {
    return first_grain_ + owner;
  }
  return is_side(owner) ? kRestingBody
                        : kFirstWallBody + static_cast<std::int32_t>(grains::wall_number(owner));
}

void Batches::clear(std::size_t grains) {
  batches_.clear();
  used_.clear();
  next_batch_.assign(grains, 0);
  first_not_full_ = 0;
}

std::int32_t Batches::add(const Contact& contact) {
  std::uint32_t& batch_after_upper = next_batch_[contact.upper];
  std::uint32_t unused = 0;
  std::uint32_t& batch_after_other =
      grains::is_particle(contact.other) ? next_batch_[grains::particle_id(contact.other)] : unused;
  auto at = std::max<std::size_t>({batch_after_upper, batch_after_other, first_not_full_});
  while (at < used_.size() && used_[at] == kLanes) {
    ++at;
  }
  if (at >= batches_.size()) {
    batches_.resize(at + 1);
    used_.resize(at + 1, 0);
  }
  const auto lane = static_cast<std::int32_t>(at * kLanes + used_[at]++);
  while (first_not_full_ < used_.size() && used_[first_not_full_] == kLanes) {
    ++first_not_full_;
  }
  batch_after_upper = batch_after_other = static_cast<std::uint32_t>(at + 1);
  set(lane, contact);
  return lane;
}

void Batches::set(std::int32_t lane, const Contact& contact) {
  Batch& batch = this->batch(lane);
  batch.upper[in_batch(lane)] = body(grains::as_owner(contact.upper));
  batch.other[in_batch(lane)] = body(contact.other);
  batch.pair[in_batch(lane)] = rule_->bodies.pair_number(*grains_, contact.upper, contact.other);
  set_numbers(lane, contact, rule_->friction_with(contact.other));
}

void Batches::remove(std::int32_t lane) {
  Batch& batch = this->batch(lane);
  batch.other[in_batch(lane)] = batch.upper[in_batch(lane)];  // of no other lane of the batch
  set_numbers(lane, {}, 0);
}

void Batches::set_numbers(std::int32_t lane, const Contact& contact, std::int32_t friction) {
  Batch& batch = this->batch(lane);
  const std::size_t i = in_batch(lane);
  batch.normal_x[i] = contact.normal.x;
  batch.normal_y[i] = contact.normal.y;
  batch.impulse.normal[i] = contact.impulse.normal;
  batch.impulse.shear[i] = contact.impulse.shear;
  batch.impulse.rolling[i] = contact.impulse.rolling;
  batch.friction[i] = friction;
}

Contact Batches::contact(std::int32_t lane) const {
  const Batch& batch = this->batch(lane);
  const std::size_t i = in_batch(lane);
  return {.normal = {batch.normal_x[i], batch.normal_y[i]},
          .impulse = {batch.impulse.normal[i], batch.impulse.shear[i], batch.impulse.rolling[i]}};
}

ContactState<std::int32_t> Batches::touching(std::int32_t lane,
                                             const std::vector<Body>& bodies) const {
  const Batch& batch = this->batch(lane);
  const std::size_t i = in_batch(lane);
  const auto velocity = [&](std::int32_t body) {
    return bodies[static_cast<std::size_t>(body)].velocity;
  };
  return {.upper = velocity(batch.upper[i]),
          .other = velocity(batch.other[i]),
          .normal_x = batch.normal_x[i],
          .normal_y = batch.normal_y[i],
          .pair = {}};
}

}  // namespace clca::contact
