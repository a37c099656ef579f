#pragma once
// Contacts that begin, change and end as grains move.

#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/engine/contact_slots.hpp"
#include "contact/engine/small_groups.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/step.hpp"
#include "contact/rule/touching.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

/// Keeps slots in line with where grains are. Does what next_contacts() does, looking only at
/// grains that have moved.
class ContactFinder {
 public:
  static constexpr double kGrainBytes =
      ContactSlots::kGrainBytes + 2 * sizeof(std::uint8_t) +
      grains::kListRoom *
          (2 * sizeof(std::uint32_t) + sizeof(std::pair<std::int64_t, std::uint32_t>) +
           kContactsPerGrain * sizeof(std::pair<Touch::Key, Touch>));

  /// Both outlive the finder.
  ContactFinder(const grains::Box& box, const Rule& rule);

  /// The direction of the lattice nearest to gravity: what is above what.
  lattice::Direction down() const { return down_; }
  /// All grains then count as moved.
  void set_down(lattice::Direction down) { down_ = down; }

  /// Fills slots from a list of contacts, which may have changed since: all grains count as moved.
  void load(const std::vector<Contact>& contacts, ContactSlots& slots);
  /// Brings contacts of `moved` grains in line; the new ones are behind the others. `walls`: their
  /// velocities. Tells `groups` where contacts have ended.
  void update(std::span<const std::uint32_t> moved, WallVelocities walls, ContactSlots& slots,
              SmallGroups& groups);
  /// Puts all in order anew and forgets the empty ones.
  void sort(ContactSlots& slots);

 private:
  /// Of two grains that have both moved one is checked for both.
  bool checked_with(std::uint32_t partner, std::uint32_t id) const {
    return moved_[partner] != 0 && partner < id;
  }
  void check_contacts(std::uint32_t id, ContactSlots& slots);
  void look_around(std::uint32_t id, const ContactSlots& slots);
  void add_found(const Touch& touch);
  void change_contact(std::int32_t at, ContactSlots& slots, SmallGroups& groups);
  void check_walls(std::uint32_t id, ContactSlots& slots);
  Touch touch(std::uint32_t first, std::uint32_t second);
  lattice::Axial apart(std::uint32_t upper, std::uint32_t other) const;

  const grains::State& state_;
  const grains::Box& box_;
  lattice::Direction down_ = lattice::Direction::down;
  bool has_moving_walls_;
  WallVelocities walls_;
  // Grains at two walls or sides, or more. How they touch these may change as walls move, also
  // where no site next to the grain changes.
  std::vector<std::uint32_t> at_several_bodies_;
  NormalTable normals_;
  std::vector<std::vector<lattice::Offset>> rings_;  // around each kind, by parity as footprints
  std::vector<std::uint32_t> ids_;                   // of those that have moved, once each
  std::vector<std::uint8_t> moved_;                  // by id
  std::vector<std::int32_t> changed_;                // slots that end, or whose upper grain changes
  std::vector<std::uint32_t> at_walls_;              // grains
  std::vector<grains::Owner> partners_;              // of the grain that is looked at
  std::vector<std::pair<Touch::Key, Touch>> found_;  // that are new, with their order
  std::vector<std::pair<std::int64_t, std::uint32_t>> order_;  // keys and grains
  std::vector<std::uint8_t> listed_;                           // by id: whether it is in order_
  std::vector<std::int32_t> of_one_;  // slots in which a grain is the upper one
  ContactSlots sorted_;
};

}  // namespace clca::contact
