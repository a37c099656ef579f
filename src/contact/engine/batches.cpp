#include "contact/engine/batches.hpp"

#include <algorithm>

namespace clca::contact {

namespace {

/// Calls `visit` with each list of a batch and the number of the content that goes there.
template <class ABatch, class Content, class Visit>
void for_each_number(ABatch& batch, Content& content, Visit visit) {
  visit(batch.normal_x, content.contact.normal.x);
  visit(batch.normal_y, content.contact.normal.y);
  visit(batch.impulse.normal, content.contact.impulse.normal);
  visit(batch.impulse.shear, content.contact.impulse.shear);
  visit(batch.impulse.rolling, content.contact.impulse.rolling);
  visit(batch.friction, content.friction);
  visit(batch.pair.mass, content.pair.mass);
  visit(batch.pair.shear_mass, content.pair.shear_mass);
  visit(batch.pair.upper_inverse_mass, content.pair.upper_inverse_mass);
  visit(batch.pair.other_inverse_mass, content.pair.other_inverse_mass);
  visit(batch.pair.upper_rolling_mass, content.pair.upper_rolling_mass);
  visit(batch.pair.other_rolling_mass, content.pair.other_rolling_mass);
  visit(batch.pair.upper_turning, content.pair.upper_turning);
  visit(batch.pair.other_turning, content.pair.other_turning);
}

}  // namespace

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

std::int32_t Batches::add(const LaneContent& content) {
  std::uint32_t& batch_after_upper = next_batch_[content.contact.upper];
  std::uint32_t unused = 0;
  std::uint32_t& batch_after_other =
      grains::is_particle(content.contact.other)
          ? next_batch_[static_cast<std::size_t>(content.contact.other)]
          : unused;
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
  set(lane, content);
  return lane;
}

void Batches::set(std::int32_t lane, const LaneContent& content) {
  Batch& batch = this->batch(lane);
  const std::size_t i = in_batch(lane);
  batch.upper[i] = body(static_cast<grains::Owner>(content.contact.upper));
  batch.other[i] = body(content.contact.other);
  for_each_number(batch, content, [i](auto& all, std::int32_t value) { all[i] = value; });
}

void Batches::remove(std::int32_t lane) {
  Batch& batch = this->batch(lane);
  const std::int32_t grain = batch.upper[in_batch(lane)];  // of no other lane of the batch
  set(lane, {});
  batch.upper[in_batch(lane)] = grain;
  batch.other[in_batch(lane)] = grain;
}

LaneContent Batches::content(std::int32_t lane) const {
  LaneContent result;
  for_each_number(batch(lane), result,
                  [i = in_batch(lane)](const auto& all, std::int32_t& value) { value = all[i]; });
  return result;
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
