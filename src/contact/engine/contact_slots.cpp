#include "contact/engine/contact_slots.hpp"

#include <utility>

namespace clca::contact {

void ContactSlots::add(const Slot& slot) {
  const auto at = static_cast<std::int32_t>(slots_.size());
  slots_.push_back(slot);
  Slot& added = slots_.back();
  added.next_upper = std::exchange(first_[slot.contact.upper], at);
  if (grains::is_particle(slot.contact.other)) {
    added.next_other = std::exchange(first_[static_cast<std::size_t>(slot.contact.other)], at);
  }
}

void ContactSlots::remove(std::int32_t at) {
  const Contact& contact = this->at(at).contact;
  unlink(at, contact.upper);
  if (grains::is_particle(contact.other)) {
    unlink(at, static_cast<std::uint32_t>(contact.other));
  }
  this->at(at).pair = nullptr;
}

void ContactSlots::turn_over(std::int32_t at) {
  Slot& slot = this->at(at);
  const std::uint32_t upper = slot.contact.upper;
  slot.contact.upper = static_cast<std::uint32_t>(slot.contact.other);
  slot.contact.other = static_cast<grains::Owner>(upper);
  slot.contact.rolling = -slot.contact.rolling;
  std::swap(slot.next_upper, slot.next_other);
}

void ContactSlots::unlink(std::int32_t at, std::uint32_t grain) {
  std::int32_t* link = &first_[grain];
  while (*link != at) {
    link = next_of(*link, grain);
  }
  *link = *next_of(at, grain);
}

}  // namespace clca::contact
