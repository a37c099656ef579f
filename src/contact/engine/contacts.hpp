#pragma once
// The contacts of the engine: in the order in which they are swept, by grain and in batches; how
// they begin, change and end as grains move; small groups of them.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "contact/engine/batch.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// A contact by its bodies, and in which lane of the batches its normal and impulses are.
struct ContactSlot {
  std::uint32_t upper = 0;
  grains::Owner other = 0;
  std::int32_t lane = -1;  ///< counted through all batches; -1: it has ended, the slot is empty
  std::int32_t next_upper = -1;  ///< the next slot of the upper grain, -1 none
  std::int32_t next_other = -1;  ///< the next slot of the other grain, -1 none
  lattice::Axial to_other = {};  ///< StepContact::to_other
};

/// Contacts in sweep order, linked by grain; their normals and impulses are in batches. A pass over
/// the batches gives what a sweep in order would give: each contact is in a later batch than those
/// before it that it shares a grain with.
class ContactSlots {
 public:
  /// Bytes for a grain and its contacts.
  static constexpr double kBytesPerGrain =
      2 * sizeof(std::int32_t) + kContactsPerGrain * grains::kListCapacityRatio *
                                     (sizeof(ContactSlot) + sizeof(Batch) / double{kLanes});

  /// Both arguments must outlive the slots.
  ContactSlots(const grains::State& grains, const Rule& rule)
      : grains_(&grains),
        rule_(&rule),
        first_grain_body_(kFirstWallBody + static_cast<std::int32_t>(grains.walls.size())) {}

  /// Number of the body of the grain with id 0. Bodies before it are no grains.
  std::size_t first_grain_body() const { return static_cast<std::size_t>(first_grain_body_); }
  /// Number of the body of a grain, a wall or a side.
  std::int32_t body_number(grains::Owner owner) const;

  /// Forgets all contacts.
  void clear(std::size_t grains);
  /// Makes room for more grains, which touch nothing.
  void add_grains(std::size_t grains);
  /// Adds a contact behind the others.
  void add_contact(const Contact& contact, lattice::Axial to_other);
  /// Empties a slot. It keeps its position in the order.
  void remove_contact(std::int32_t at);
  /// Changes a contact. The other grain may have become the upper one.
  void set_contact(std::int32_t at, const Contact& contact, lattice::Axial to_other);

  std::span<const ContactSlot> slots() const { return slots_; }
  const ContactSlot& slot(std::int32_t slot) const {
    return slots_[static_cast<std::size_t>(slot)];
  }
  std::vector<Batch>& batches() { return batches_; }
  Contact contact(std::int32_t at) const;
  std::int32_t normal_impulse(std::int32_t at) const {
    return batch(at).impulse.normal[lane_in_batch(at)];
  }
  /// StepContact::bounce_velocity of the contact.
  std::int32_t& bounce_velocity(std::int32_t at) {
    return batch(at).bounce_velocity[lane_in_batch(at)];
  }
  /// Velocity with which its bodies part now. `bodies`: velocities by number of the body.
  std::int32_t separation_velocity(std::int32_t at,
                                   const std::vector<AlignedVelocity>& bodies) const;

  /// Calls `visit` with the number of each slot of a grain, which it may change or empty.
  template <class Visit>
  void for_each_slot(std::uint32_t grain, Visit visit) const {
    for (std::int32_t at = first_slot_[grain]; at >= 0;) {
      visit(at);
      const ContactSlot& slot = this->slot(at);
      at = slot.upper == grain ? slot.next_upper : slot.next_other;
    }
  }
  bool touches_anything(std::uint32_t grain) const { return first_slot_[grain] >= 0; }

 private:
  std::size_t lane(std::int32_t at) const { return static_cast<std::size_t>(this->slot(at).lane); }
  std::size_t lane_in_batch(std::int32_t at) const { return lane(at) % kLanes; }
  const Batch& batch(std::int32_t at) const { return batches_[lane(at) / kLanes]; }
  Batch& batch(std::int32_t at) { return batches_[lane(at) / kLanes]; }
  std::int32_t new_lane(const Contact& contact);
  void fill_lane(std::int32_t at, const Contact& contact, std::int32_t friction);
  void unlink(std::int32_t at, std::uint32_t grain);

  const grains::State* grains_;  // pointers: slots are swapped
  const Rule* rule_;
  std::int32_t first_grain_body_;
  std::vector<ContactSlot> slots_;
  std::vector<std::int32_t> first_slot_;  // by grain, -1 none
  std::vector<Batch> batches_;
  std::vector<std::uint8_t> used_lanes_;   // by batch, emptied ones included
  std::vector<std::uint32_t> next_batch_;  // by grain: the first behind all of its contacts
  std::size_t first_not_full_ = 0;         // all batches before it are full
};

/// The groups that active_small_groups() finds. Of most grains it is known from earlier steps that
/// their group is not small.
class SmallGroups {
 public:
  /// Bytes for a grain.
  static constexpr double kBytesPerGrain = sizeof(std::uint64_t) + sizeof(std::uint8_t) +
                                           grains::kListCapacityRatio * sizeof(std::uint32_t);

  /// Nothing is known any more.
  void clear() { may_be_small_.clear(); }
  /// A grain has lost a contact.
  void note_lost_contact(std::uint32_t grain) { changed_.push_back(grain); }
  /// Begins a step: contacts have begun and ended. No group is active.
  void begin_step(std::size_t grains, const ContactSlots& slots);
  /// A contact of a grain carries or bounces.
  void mark_active(std::uint32_t grain, const ContactSlots& slots) {
    if (may_be_small_[grain] != 0 && decided_step_[grain] != steps_) {
      add_group(grain, slots);
    }
  }
  /// The slots of each that is active, in their order.
  const std::vector<std::vector<std::int32_t>>& active_slots() const { return active_; }

 private:
  void add_group(std::uint32_t grain, const ContactSlots& slots);
  bool find_group(std::uint32_t grain, const ContactSlots& slots);

  std::vector<std::vector<std::int32_t>> active_;
  std::vector<std::uint32_t> changed_;      // grains that have lost contacts, maybe more than once
  std::vector<std::uint8_t> may_be_small_;  // by grain: its group; true of all grains of small ones
  // By grain: the last step in which its group was found to be active, or not small.
  std::vector<std::uint64_t> decided_step_;
  std::uint64_t steps_ = 0;                  // so far
  std::vector<std::uint32_t> group_grains_;  // grains of the group that is looked at
};

/// Keeps slots in line with where grains are, as next_contacts(), by grains that have moved.
class ContactFinder {
 public:
  /// Bytes for a grain, with those of ContactSlots.
  static constexpr double kBytesPerGrain =
      ContactSlots::kBytesPerGrain + sizeof(std::uint8_t) +
      kContactsPerGrain * sizeof(std::pair<std::int64_t, std::int32_t>) +
      grains::kListCapacityRatio *
          (2 * sizeof(std::uint32_t) +
           kContactsPerGrain * sizeof(std::pair<StepContact::Key, StepContact>));

  /// Both arguments must outlive the finder.
  ContactFinder(const grains::Box& box, const Rule& rule);

  /// The direction of the lattice nearest to gravity: what is above what.
  lattice::Direction down() const { return down_; }
  /// The next update() then needs all grains.
  void set_down(lattice::Direction down) { down_ = down; }

  /// Fills slots from a list of contacts, some of which may have ended since: the next update()
  /// then needs all grains.
  void load(const std::vector<Contact>& contacts, ContactSlots& slots);
  /// Brings contacts of `moved` grains in line; the new ones are behind the others. `walls`: their
  /// velocities. Tells `groups` where contacts have ended.
  void update(std::span<const std::uint32_t> moved, const WallVelocities& walls,
              ContactSlots& slots, SmallGroups& groups);
  /// Puts all slots in order anew and forgets the empty ones.
  void sort(ContactSlots& slots);

 private:
  /// Whether both grains have moved and their contact is checked at the partner.
  bool checked_with(std::uint32_t partner, std::uint32_t id) const {
    return moved_[partner] != 0 && partner < id;
  }
  void check_contacts(std::uint32_t id, ContactSlots& slots, SmallGroups& groups);
  bool find_new_contacts(std::uint32_t id, const ContactSlots& slots);
  void add_found(const StepContact& touch) {
    new_contacts_.emplace_back(touch.key(state_, down_), touch);
  }
  void check_walls(std::uint32_t id, const WallVelocities& walls, ContactSlots& slots);
  StepContact contact_between(std::uint32_t first, std::uint32_t second);
  lattice::Axial vector_between(std::uint32_t upper, std::uint32_t other) const;

  const grains::State& state_;
  const grains::Box& box_;
  lattice::Direction down_ = lattice::Direction::down;
  bool has_moving_walls_;
  // Grains at two walls or sides, or more. How they touch these may change as walls move, also
  // where no site next to the grain changes.
  std::vector<std::uint32_t> at_several_bodies_;
  NormalTable normals_;
  std::vector<std::uint32_t> ids_;       // of those that have moved, once each
  std::vector<std::uint8_t> moved_;      // by id
  std::vector<grains::Owner> partners_;  // that the grain looked at touches
  std::vector<std::pair<StepContact::Key, StepContact>> new_contacts_;  // with their order
  std::vector<std::pair<std::int64_t, std::int32_t>> order_;            // keys and slots
  ContactSlots reordered_slots_;  // of sort(), kept for its memory
};

}  // namespace clca::contact
