#pragma once
// The contacts of the engine: in the order in which they are swept, and by grain.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/bodies.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// A contact with what a sweep needs of it.
struct Slot {
  Contact contact;
  UnitVector normal;
  std::int32_t bounce = 0;
  std::int32_t friction = 0;
  const Pair* pair = nullptr;    ///< nullptr: the contact has ended, the slot is empty
  bool is_new = false;           ///< in this step
  std::int32_t next_upper = -1;  ///< the next slot of the upper grain, -1 none
  std::int32_t next_other = -1;
};

/// Slots in order, linked by grain.
class ContactSlots {
 public:
  void resize(std::size_t grains) { first_.resize(grains, -1); }
  void clear() {
    slots_.clear();
    std::fill(first_.begin(), first_.end(), -1);
  }
  void add(const Slot& slot);
  /// Empties a slot. It keeps its place in the order.
  void remove(std::int32_t at);
  /// Makes the other grain the upper one.
  void turn_over(std::int32_t at);

  std::vector<Slot>& all() { return slots_; }
  const std::vector<Slot>& all() const { return slots_; }
  Slot& at(std::int32_t slot) { return slots_[static_cast<std::size_t>(slot)]; }

  /// Calls `visit` with the number of each slot of a grain; it may remove or turn over that slot.
  template <class Visit>
  void for_each(std::uint32_t grain, Visit visit) {
    for (std::int32_t at = first_[grain]; at >= 0;) {
      const std::int32_t next = *next_of(at, grain);
      visit(at);
      at = next;
    }
  }
  /// Whether a grain touches this grain or wall.
  bool touches(std::uint32_t grain, grains::Owner other) {
    for (std::int32_t at = first_[grain]; at >= 0; at = *next_of(at, grain)) {
      const Contact& contact = this->at(at).contact;
      if (contact.other == other || (contact.upper == static_cast<std::uint32_t>(other) &&
                                     contact.other == static_cast<grains::Owner>(grain))) {
        return true;
      }
    }
    return false;
  }

 private:
  std::int32_t* next_of(std::int32_t at, std::uint32_t grain) {
    Slot& slot = this->at(at);
    return slot.contact.upper == grain ? &slot.next_upper : &slot.next_other;
  }
  void unlink(std::int32_t at, std::uint32_t grain);

  std::vector<Slot> slots_;
  std::vector<std::int32_t> first_;  // slot by grain, -1 none
};

}  // namespace clca::contact
