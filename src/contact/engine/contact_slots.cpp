#include "contact/engine/contact_slots.hpp"

#include <utility>

namespace clca::contact {

void ContactSlots::clear(std::size_t grains) {
  slots_.clear();
  first_.assign(grains, -1);
  batches_.clear(grains);
}

void ContactSlots::add(const Contact& contact, lattice::Axial apart) {
  const auto at = static_cast<std::int32_t>(slots_.size());
  Slot slot = {.upper = contact.upper,
               .other = contact.other,
               .lane = batches_.add(contact),
               .apart = apart};
  slot.next_upper = std::exchange(first_[slot.upper], at);
  if (grains::is_particle(slot.other)) {
    slot.next_other = std::exchange(first_[grains::particle_id(slot.other)], at);
  }
  slots_.push_back(slot);
}

void ContactSlots::remove(std::int32_t at) {
  Slot& slot = slots_[static_cast<std::size_t>(at)];
  unlink(at, slot.upper);
  if (grains::is_particle(slot.other)) {
    unlink(at, grains::particle_id(slot.other));
  }
  batches_.remove(std::exchange(slot.lane, -1));
}

void ContactSlots::set(std::int32_t at, const Contact& contact, lattice::Axial apart) {
  Slot& slot = slots_[static_cast<std::size_t>(at)];
  if (slot.upper != contact.upper) {
    std::swap(slot.next_upper, slot.next_other);
  }
  slot.upper = contact.upper;
  slot.other = contact.other;
  slot.apart = apart;
  batches_.set(slot.lane, contact);
}

Contact ContactSlots::contact(std::int32_t at) const {
  const Slot& slot = this->at(at);
  Contact result = batches_.contact(slot.lane);
  result.upper = slot.upper;
  result.other = slot.other;
  return result;
}

void ContactSlots::unlink(std::int32_t at, std::uint32_t grain) {
  std::int32_t* link = &first_[grain];
  while (*link != at) {
    link = next_of(*link, grain);
  }
  *link = *next_of(at, grain);
}

}  // namespace clca::contact
