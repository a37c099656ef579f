#pragma once
// Contacts that begin, change and end as grains move.

#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "contact/engine/contact_slots.hpp"
#include "contact/rule/normal_table.hpp"
#include "contact/rule/step.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// Keeps slots in line with where grains are. Does what next_contacts() does, looking only at
/// grains that have moved.
class ContactFinder {
 public:
  ContactFinder(const grains::State& state, const grains::Occupancy& occupancy,
                const grains::FootprintTable& footprints, const Rule& rule);

  /// The direction of the lattice nearest to gravity: what is above what.
  lattice::Direction down() const { return down_; }
  /// All grains then count as moved.
  void set_down(lattice::Direction down) { down_ = down; }

  /// Fills slots from a list of contacts, which may have changed since: all grains count as moved.
  void load(const std::vector<Contact>& contacts, ContactSlots& slots);
  /// Brings contacts of `moved` grains in line; the new ones are behind the others. Returns the
  /// number of the first of them.
  std::size_t update(std::span<const std::uint32_t> moved, ContactSlots& slots);
  /// Puts all in order anew and forgets the empty ones. `lanes`: of some contacts, which are moved
  /// to others.
  void sort(ContactSlots& slots, std::vector<std::int32_t>& lanes);

 private:
  void check_grains(std::uint32_t id, ContactSlots& slots);
  void look_around(std::uint32_t id, ContactSlots& slots);
  void check_walls(std::uint32_t id, ContactSlots& slots);
  LaneContent content(const Touch& touch) const;
  Touch touch(std::uint32_t first, std::uint32_t second);
  lattice::Axial apart(std::uint32_t upper, std::uint32_t other) const;

  const grains::State& state_;
  const grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  const Rule& rule_;
  lattice::Direction down_ = lattice::Direction::down;
  NormalTable normals_;
  std::vector<std::vector<lattice::Offset>> rings_;  // around each kind, by parity as footprints
  std::vector<Touch> found_;
  std::vector<LaneContent> sorted_;
};

}  // namespace clca::contact
