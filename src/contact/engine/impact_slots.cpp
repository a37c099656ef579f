#include "contact/engine/impact_slots.hpp"

#include <algorithm>

namespace clca::contact {

namespace {

/// Sets `near` to the grains that contacts connect with the first of it; false if they are too
/// many.
bool find_connected(const ContactSlots& slots, std::vector<std::uint32_t>& near) {
  for (std::size_t i = 0; i < near.size() && near.size() <= kMostGrains; ++i) {
    slots.for_each(near[i], [&, grain = near[i]](std::int32_t at) {
      const Slot& slot = slots.at(at);
      if (!grains::is_particle(slot.other)) {
        return;
      }
      const auto next = slot.upper == grain ? grains::particle_id(slot.other) : slot.upper;
      if (std::find(near.begin(), near.end(), next) == near.end()) {
        near.push_back(next);
      }
    });
  }
  return near.size() <= kMostGrains;
}

}  // namespace

std::vector<std::int32_t> isolated_impact(const ContactSlots& slots, std::int32_t at) {
  std::vector<std::uint32_t> near = {slots.at(at).upper};
  if (!find_connected(slots, near)) {
    return {};
  }
  std::vector<std::int32_t> found;
  for (const std::uint32_t grain : near) {
    slots.for_each(grain, [&](std::int32_t of_grain) { found.push_back(of_grain); });
  }
  // Both grains of a contact list it.
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace clca::contact
