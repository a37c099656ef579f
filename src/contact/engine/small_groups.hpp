#pragma once

#include <cstdint>
#include <vector>

#include "contact/engine/contact_slots.hpp"
#include "contact/rule/groups.hpp"

namespace clca::contact {

/// The groups that active_groups() finds. Of most grains it stays known that their group is not
/// small.
class SmallGroups {
 public:
  static constexpr double kGrainBytes =
      sizeof(std::uint64_t) + sizeof(std::uint8_t) + grains::kListRoom * sizeof(std::uint32_t);

  /// Nothing is known any more.
  void clear() { may_be_small_.clear(); }
  /// A grain has lost a contact.
  void lost_contact(std::uint32_t grain) { changed_.push_back(grain); }
  /// Begins a step: contacts have begun and ended. No group is active.
  void begin(std::size_t grains, const ContactSlots& slots);
  /// A contact of a grain carries or bounces.
  void set_active(std::uint32_t grain, const ContactSlots& slots) {
    if (may_be_small_[grain] != 0 && seen_[grain] != steps_) {
      add_group(grain, slots);
    }
  }
  /// The slots of each that is active, in their order.
  const std::vector<std::vector<std::int32_t>>& active() const { return active_; }

 private:
  void add_group(std::uint32_t grain, const ContactSlots& slots);
  bool find(std::uint32_t grain, const ContactSlots& slots);

  std::vector<std::vector<std::int32_t>> active_;
  std::vector<std::uint32_t> changed_;      // grains that have lost contacts, maybe more than once
  std::vector<std::uint8_t> may_be_small_;  // by grain: its group; true of all grains of small ones
  // By grain: the last step in which its group was found not to be small, or active.
  std::vector<std::uint64_t> seen_;
  std::uint64_t steps_ = 0;
  std::vector<std::uint32_t> near_;  // grains of the group that is looked at
};

}  // namespace clca::contact
