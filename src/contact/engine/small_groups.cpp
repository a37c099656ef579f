#include "contact/engine/small_groups.hpp"

#include <algorithm>

namespace clca::contact {

void SmallGroups::begin(std::size_t grains, const ContactSlots& slots) {
  ++steps_;
  active_.clear();
  may_be_small_.resize(grains, 1);
  seen_.resize(grains, 0);
  for (const std::uint32_t grain : changed_) {
    if (seen_[grain] != steps_) {
      find(grain, slots);
    }
  }
  changed_.clear();
}

void SmallGroups::add_group(std::uint32_t grain, const ContactSlots& slots) {
  if (!find(grain, slots)) {
    return;
  }
  std::vector<std::int32_t>& group = active_.emplace_back();
  for (const std::uint32_t id : near_) {
    seen_[id] = steps_;
    slots.for_each(id, [&](std::int32_t at) { group.push_back(at); });
  }
  // Both grains of a contact list it.
  std::sort(group.begin(), group.end());
  group.erase(std::unique(group.begin(), group.end()), group.end());
}

/// Sets near_ to the group of a grain. Returns false if it is not small; near_ is then a part of
/// it.
bool SmallGroups::find(std::uint32_t grain, const ContactSlots& slots) {
  near_ = {grain};
  bool is_small = true;
  for (std::size_t i = 0; is_small && i < near_.size(); ++i) {
    slots.for_each(near_[i], [&, id = near_[i]](std::int32_t at) {
      const Slot& slot = slots.at(at);
      if (!grains::is_particle(slot.other)) {
        return;
      }
      const auto next = slot.upper == id ? grains::particle_id(slot.other) : slot.upper;
      if (std::find(near_.begin(), near_.end(), next) == near_.end()) {
        near_.push_back(next);
        is_small = is_small && seen_[next] != steps_;  // else that group is not
      }
    });
    is_small = is_small && near_.size() <= kMostGrains;
  }
  for (const std::uint32_t id : near_) {
    may_be_small_[id] = is_small ? 1 : 0;
    seen_[id] = is_small ? seen_[id] : steps_;
  }
  return is_small;
}

}  // namespace clca::contact
