#include "contact/engine/contacts.hpp"

#include <algorithm>
#include <tuple>

#include "contact/rule/step.hpp"

namespace clca::contact {

namespace {

/// One contact of a batch after the other.
struct OneLane {
  using Int = std::int32_t;
  static constexpr std::size_t kWidth = 1;

  static Int load(const std::int32_t* from) { return *from; }
  static void store(Int value, std::int32_t* to) { *to = value; }
  static PairCoefficients coefficients(const PairCoefficients* pairs, const std::int32_t* at) {
    return pairs[*at];
  }
  static Velocity<> velocities(const AlignedVelocity* bodies, const std::int32_t* at) {
    return bodies[*at].velocity;
  }
  static void set_velocities(AlignedVelocity* bodies, const std::int32_t* at,
                             const Velocity<>& velocity) {
    bodies[*at].velocity = velocity;
  }
};

}  // namespace

PassFunction plain_pass_function() {
  return carry_out_pass<OneLane>;
}

std::int32_t ContactSlots::body_number(grains::Owner owner) const {
  if (grains::is_particle(owner)) {
    return first_grain_body_ + owner;
  }
  return is_side(owner) ? kRestingBody
                        : kFirstWallBody + static_cast<std::int32_t>(grains::wall_number(owner));
}

void ContactSlots::clear(std::size_t grains) {
  slots_.clear();
  first_slot_.assign(grains, -1);
  batches_.clear();
  used_lanes_.clear();
  next_batch_.assign(grains, 0);
  first_not_full_ = 0;
}

void ContactSlots::add_grains(std::size_t grains) {
  first_slot_.resize(grains, -1);
  next_batch_.resize(grains, 0);
}

void ContactSlots::add_contact(const Contact& contact, lattice::Axial to_other) {
  const auto at = static_cast<std::int32_t>(slots_.size());
  ContactSlot& slot = slots_.emplace_back();
  slot.upper = contact.upper;
  slot.lane = new_lane(contact);
  slot.next_upper = std::exchange(first_slot_[contact.upper], at);
  if (grains::is_particle(contact.other)) {
    slot.next_other = std::exchange(first_slot_[grains::particle_id(contact.other)], at);
  }
  set_contact(at, contact, to_other);
}

void ContactSlots::remove_contact(std::int32_t at) {
  ContactSlot& slot = slots_[static_cast<std::size_t>(at)];
  unlink(at, slot.upper);
  if (grains::is_particle(slot.other)) {
    unlink(at, grains::particle_id(slot.other));
  }
  batch(at).other[lane_in_batch(at)] =
      batch(at).upper[lane_in_batch(at)];  // of no other lane of the batch
  fill_lane(at, {}, 0);
  slot.lane = -1;
}

void ContactSlots::set_contact(std::int32_t at, const Contact& contact, lattice::Axial to_other) {
  ContactSlot& slot = slots_[static_cast<std::size_t>(at)];
  if (slot.upper != contact.upper) {
    std::swap(slot.next_upper, slot.next_other);
  }
  slot.upper = contact.upper;
  slot.other = contact.other;
  slot.to_other = to_other;
  Batch& batch = this->batch(at);
  batch.upper[lane_in_batch(at)] = body_number(grains::as_owner(contact.upper));
  batch.other[lane_in_batch(at)] = body_number(contact.other);
  batch.pair_index[lane_in_batch(at)] = pair_index(*grains_, contact.upper, contact.other);
  fill_lane(at, contact, rule_->friction_with(contact.other));
}

Contact ContactSlots::contact(std::int32_t at) const {
  const Batch& batch = this->batch(at);
  const std::size_t i = lane_in_batch(at);
  return {.upper = this->slot(at).upper,
          .other = this->slot(at).other,
          .normal = {batch.normal_x[i], batch.normal_y[i]},
          .impulse = {batch.impulse.normal[i], batch.impulse.shear[i], batch.impulse.rolling[i]}};
}

std::int32_t ContactSlots::separation_velocity(std::int32_t at,
                                               const std::vector<AlignedVelocity>& bodies) const {
  const Batch& batch = this->batch(at);
  const std::size_t i = lane_in_batch(at);
  return contact::separation_velocity(
      ContactBodies<>{.upper = bodies[static_cast<std::size_t>(batch.upper[i])].velocity,
                      .other = bodies[static_cast<std::size_t>(batch.other[i])].velocity,
                      .normal_x = batch.normal_x[i],
                      .normal_y = batch.normal_y[i],
                      .coefficients = {}});
}

/// The next lane of the first batch that is not full, behind all batches of contacts of both.
std::int32_t ContactSlots::new_lane(const Contact& contact) {
  std::uint32_t& after_upper = next_batch_[contact.upper];
  std::uint32_t unused = 0;
  std::uint32_t& after_other =
      grains::is_particle(contact.other) ? next_batch_[grains::particle_id(contact.other)] : unused;
  auto at = std::max<std::size_t>({after_upper, after_other, first_not_full_});
  while (at < used_lanes_.size() && used_lanes_[at] == kLanes) {
    ++at;
  }
  if (at >= batches_.size()) {
    batches_.resize(at + 1);
    used_lanes_.resize(at + 1, 0);
  }
  const auto lane = static_cast<std::int32_t>(at * kLanes + used_lanes_[at]++);
  while (first_not_full_ < used_lanes_.size() && used_lanes_[first_not_full_] == kLanes) {
    ++first_not_full_;
  }
  after_upper = after_other = static_cast<std::uint32_t>(at + 1);
  return lane;
}

void ContactSlots::fill_lane(std::int32_t at, const Contact& contact, std::int32_t friction) {
  Batch& batch = this->batch(at);
  const std::size_t i = lane_in_batch(at);
  batch.normal_x[i] = contact.normal.x;
  batch.normal_y[i] = contact.normal.y;
  batch.impulse.normal[i] = contact.impulse.normal;
  batch.impulse.shear[i] = contact.impulse.shear;
  batch.impulse.rolling[i] = contact.impulse.rolling;
  batch.friction[i] = friction;
}

void ContactSlots::unlink(std::int32_t at, std::uint32_t grain) {
  const auto next_of = [&](std::int32_t number) {
    ContactSlot& slot = slots_[static_cast<std::size_t>(number)];
    return slot.upper == grain ? &slot.next_upper : &slot.next_other;
  };
  std::int32_t* link = &first_slot_[grain];
  while (*link != at) {
    link = next_of(*link);
  }
  *link = *next_of(at);
}

void SmallGroups::begin_step(std::size_t grains, const ContactSlots& slots) {
  ++steps_;
  active_.clear();
  may_be_small_.resize(grains, 1);
  decided_step_.resize(grains, 0);
  for (const std::uint32_t grain : changed_) {
    if (decided_step_[grain] != steps_) {
      find_group(grain, slots);
    }
  }
  changed_.clear();
}

void SmallGroups::add_group(std::uint32_t grain, const ContactSlots& slots) {
  if (!find_group(grain, slots)) {
    return;
  }
  std::vector<std::int32_t>& group = active_.emplace_back();
  for (const std::uint32_t id : group_grains_) {
    decided_step_[id] = steps_;
    slots.for_each_slot(id, [&](std::int32_t at) { group.push_back(at); });
  }
  // Both grains of a contact list it.
  std::ranges::sort(group);
  group.erase(std::unique(group.begin(), group.end()), group.end());
}

/// Sets group_grains_ to the group of a grain. Returns false if it is not small; group_grains_ is
/// then a part of it.
bool SmallGroups::find_group(std::uint32_t grain, const ContactSlots& slots) {
  group_grains_ = {grain};
  bool is_small = true;
  for (std::size_t i = 0; is_small && i < group_grains_.size(); ++i) {
    slots.for_each_slot(group_grains_[i], [&, id = group_grains_[i]](std::int32_t at) {
      const ContactSlot& slot = slots.slot(at);
      if (!grains::is_particle(slot.other)) {
        return;
      }
      const auto next = slot.upper == id ? grains::particle_id(slot.other) : slot.upper;
      if (std::ranges::find(group_grains_, next) == group_grains_.end()) {
        group_grains_.push_back(next);
        is_small = is_small && decided_step_[next] != steps_;  // else that group is not
      }
    });
    is_small = is_small && group_grains_.size() <= kMaxSmallGroup;
  }
  for (const std::uint32_t id : group_grains_) {
    may_be_small_[id] = is_small ? 1 : 0;
    decided_step_[id] = is_small ? decided_step_[id] : steps_;
  }
  return is_small;
}

ContactFinder::ContactFinder(const grains::Box& box, const Rule& rule)
    : state_(box.state),
      box_(box),
      has_moving_walls_(std::ranges::any_of(
          state_.walls, [](const grains::Wall& wall) { return wall.motion.has_value(); })),
      normals_(state_.kinds),
      reordered_slots_(state_, rule) {}

void ContactFinder::load(const std::vector<Contact>& contacts, ContactSlots& slots) {
  slots.clear(state_.particles.size());
  for (const Contact& contact : contacts) {
    slots.add_contact(contact,
                      grains::is_particle(contact.other)
                          ? vector_between(contact.upper, grains::particle_id(contact.other))
                          : lattice::Axial());
  }
}

void ContactFinder::update(std::span<const std::uint32_t> moved, const WallVelocities& walls,
                           ContactSlots& slots, SmallGroups& groups) {
  moved_.resize(state_.particles.size());
  ids_.clear();
  const auto look_at = [&](std::uint32_t id) {
    if (std::exchange(moved_[id], 1) == 0) {
      ids_.push_back(id);
    }
  };
  std::ranges::for_each(moved, look_at);
  std::ranges::for_each(at_several_bodies_, look_at);
  at_several_bodies_.clear();
  new_contacts_.clear();
  for (const std::uint32_t id : ids_) {
    check_contacts(id, slots, groups);
    if (state_.particles[id].present && find_new_contacts(id, slots)) {
      check_walls(id, walls, slots);
    }
  }
  for (const std::uint32_t id : ids_) {
    moved_[id] = 0;
  }
  std::ranges::sort(new_contacts_, {}, [](const auto& found) { return found.first; });
  for (const auto& [key, touch] : new_contacts_) {
    slots.add_contact(touch.contact, touch.to_other);
  }
}

/// Ends and updates contacts of a grain with other grains, and ends all of one that is gone; those
/// with walls are left to check_walls().
void ContactFinder::check_contacts(std::uint32_t id, ContactSlots& slots, SmallGroups& groups) {
  slots.for_each_slot(id, [&](std::int32_t at) {
    const ContactSlot& slot = slots.slot(at);
    const bool with_grain = grains::is_particle(slot.other);
    const auto other = grains::particle_id(slot.other);
    const bool present =
        state_.particles[slot.upper].present && (!with_grain || state_.particles[other].present);
    if (with_grain ? checked_with(slot.upper == id ? other : slot.upper, id) : present) {
      return;
    }
    StepContact now = present ? contact_between(slot.upper, other) : StepContact();
    if (now.contact.normal == UnitVector()) {
      groups.note_lost_contact(slot.upper);
      if (with_grain) {
        groups.note_lost_contact(other);
      }
      slots.remove_contact(at);
    } else {
      const Impulse<> impulse = slots.contact(at).impulse;
      now.contact.impulse =
          now.contact.upper == slot.upper ? impulse : with_bodies_swapped(impulse);
      slots.set_contact(at, now.contact, now.to_other);
    }
  });
}

/// Finds contacts with other grains that begin. Returns whether the grain is at a wall or side, or
/// was.
bool ContactFinder::find_new_contacts(std::uint32_t id, const ContactSlots& slots) {
  partners_.clear();
  slots.for_each_slot(id, [&](std::int32_t at) {
    const ContactSlot& slot = slots.slot(at);
    partners_.push_back(slot.upper == id ? slot.other : grains::as_owner(slot.upper));
  });
  bool at_wall = std::ranges::any_of(partners_, grains::is_obstacle);
  grains::Owner before = grains::kFree;
  const grains::Particle& grain = state_.particles[id];
  box_.for_each_index(grain, box_.footprints.footprint(grain).neighbours, [&](std::size_t index) {
    const grains::Owner owner = box_.occupancy.owner(index);
    if (owner == before) {
      return;
    }
    before = owner;
    at_wall = at_wall || grains::is_obstacle(owner);
    const auto other = grains::particle_id(owner);
    if (grains::is_particle(owner) && !checked_with(other, id) &&
        std::ranges::find(partners_, owner) == partners_.end()) {
      partners_.push_back(owner);
      const StepContact found = contact_between(id, other);
      if (found.contact.normal != UnitVector()) {
        add_found(found);
      }
    }
  });
  return at_wall;
}

/// Ends, updates and adds contacts of a grain with walls and sides.
void ContactFinder::check_walls(std::uint32_t id, const WallVelocities& walls,
                                ContactSlots& slots) {
  std::vector<StepContact> now;
  if (add_wall_contacts(box_, id, walls, now) > 1 && has_moving_walls_) {
    at_several_bodies_.push_back(id);
  }
  std::vector<Contact> before;
  std::vector<std::int32_t> slots_before;
  slots.for_each_slot(id, [&](std::int32_t at) {
    if (grains::is_obstacle(slots.slot(at).other)) {
      before.push_back(slots.contact(at));
      slots_before.push_back(at);
    }
  });
  const std::vector<const StepContact*> next = successors(before, now);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (next[i] == nullptr) {
      slots.remove_contact(slots_before[i]);
      continue;
    }
    Contact contact = next[i]->contact;
    contact.impulse = before[i].impulse;
    slots.set_contact(slots_before[i], contact, {});
  }
  for (const StepContact& touch : now) {
    if (std::ranges::find(next, &touch) == next.end()) {
      add_found(touch);
    }
  }
}

void ContactFinder::sort(ContactSlots& slots) {
  order_.clear();
  order_.reserve(slots.slots().size());
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots.slots().size()); ++at) {
    if (slots.slot(at).lane >= 0) {
      order_.emplace_back(order_key(state_, down_, slots.slot(at).upper), at);
    }
  }
  const auto rank = [&](std::int32_t at) {
    return std::tie(slots.slot(at).to_other, slots.slot(at).other);
  };
  // From the order of the last time, which is nearly right.
  std::ranges::stable_sort(order_, [&](const auto& one, const auto& other) {
    return one.first != other.first ? one.first < other.first
                                    : rank(one.second) < rank(other.second);
  });
  reordered_slots_.clear(state_.particles.size());
  for (const auto& [key, at] : order_) {
    reordered_slots_.add_contact(slots.contact(at), slots.slot(at).to_other);
  }
  std::swap(slots, reordered_slots_);
}

StepContact ContactFinder::contact_between(std::uint32_t first, std::uint32_t second) {
  const bool in_order = is_above(state_, down_, first, second);
  const std::uint32_t upper = in_order ? first : second;
  const std::uint32_t lower = in_order ? second : first;
  const lattice::Axial to_other = vector_between(upper, lower);
  return {.contact = {.upper = upper,
                      .other = grains::as_owner(lower),
                      .normal = normals_.normal(state_.particles[upper].kind,
                                                state_.particles[lower].kind, to_other)},
          .to_other = to_other};
}

lattice::Axial ContactFinder::vector_between(std::uint32_t upper, std::uint32_t other) const {
  return state_.lattice.shortest_vector(state_.particles[upper].site(),
                                        state_.particles[other].site());
}

}  // namespace clca::contact
