#pragma once
// The contacts of the engine: in the order in which they are swept, and by grain.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/engine/batches.hpp"

namespace clca::contact {

/// A contact by its bodies, and where its numbers are.
struct Slot {
  std::uint32_t upper = 0;
  grains::Owner other = 0;
  std::int32_t lane = -1;        ///< -1: the contact has ended, the slot is empty
  std::int32_t next_upper = -1;  ///< the next slot of the upper grain, -1 none
  std::int32_t next_other = -1;
  lattice::Axial apart = {};  ///< see Touch
};

/// Slots in order, linked by grain. Their numbers are in batches.
class ContactSlots {
 public:
  /// With its contacts.
  static constexpr double kGrainBytes =
      2 * sizeof(std::int32_t) +
      kContactsPerGrain * grains::kListRoom * (sizeof(Slot) + sizeof(Batch) / double{kLanes});

  /// Both outlive the slots.
  ContactSlots(const grains::State& grains, const Rule& rule) : batches_(grains, rule) {}

  void clear(std::size_t grains);
  /// Makes room for more grains, which touch nothing.
  void add_grains(std::size_t grains) {
    first_.resize(grains, -1);
    batches_.add_grains(grains);
  }
  void add(const Contact& contact, lattice::Axial apart);
  /// Empties a slot. It keeps its position in the order.
  void remove(std::int32_t at);
  /// Changes a contact. The other grain may have become the upper one.
  void set(std::int32_t at, const Contact& contact, lattice::Axial apart);
  /// The grains have moved, and the upper one still is.
  void set_apart(std::int32_t at, lattice::Axial apart, UnitVector normal) {
    slots_[static_cast<std::size_t>(at)].apart = apart;
    batches_.set_normal(this->at(at).lane, normal);
  }
  Contact contact(std::int32_t at) const;

  std::span<const Slot> all() const { return slots_; }
  const Slot& at(std::int32_t slot) const { return slots_[static_cast<std::size_t>(slot)]; }
  Batches& batches() { return batches_; }
  const Batches& batches() const { return batches_; }

  /// Calls `visit` with the number of each slot of a grain.
  template <class Visit>
  void for_each(std::uint32_t grain, Visit visit) const {
    for (std::int32_t at = first_[grain]; at >= 0; at = next(at, grain)) {
      visit(at);
    }
  }
  /// The same; `visit` may change or empty that slot.
  template <class Visit>
  void change_each(std::uint32_t grain, Visit visit) {
    for (std::int32_t at = first_[grain]; at >= 0;) {
      const std::int32_t next = *next_of(at, grain);
      visit(at);
      at = next;
    }
  }
  bool touches_anything(std::uint32_t grain) const { return first_[grain] >= 0; }

 private:
  std::int32_t next(std::int32_t at, std::uint32_t grain) const {
    const Slot& slot = this->at(at);
    return slot.upper == grain ? slot.next_upper : slot.next_other;
  }
  std::int32_t* next_of(std::int32_t at, std::uint32_t grain) {
    Slot& slot = slots_[static_cast<std::size_t>(at)];
    return slot.upper == grain ? &slot.next_upper : &slot.next_other;
  }
  void unlink(std::int32_t at, std::uint32_t grain);

  std::vector<Slot> slots_;
  std::vector<std::int32_t> first_;  // slot by grain, -1 none
  Batches batches_;
};

}  // namespace clca::contact
