#pragma once
// Contacts put into batches.

#include <cstdint>
#include <vector>

#include "contact/engine/batch.hpp"
#include "contact/rule/rule.hpp"

namespace clca::contact {

/// Batches that give what a sweep over the contacts, in the order in which they were added, would
/// give: each contact is in a later batch than those before it that it shares a grain with.
class Batches {
 public:
  /// Both outlive the batches.
  Batches(const grains::State& grains, const Rule& rule)
      : grains_(&grains),
        rule_(&rule),
        first_grain_(kFirstWallBody + static_cast<std::int32_t>(grains.walls.size())) {}

  /// The body of the grain with id 0. Those before it are no grains.
  std::size_t first_grain() const { return static_cast<std::size_t>(first_grain_); }
  /// The body of a grain, a wall or a side.
  std::int32_t body(grains::Owner owner) const;

  /// Forgets all contacts.
  void clear(std::size_t grains);
  /// There are more grains.
  void add_grains(std::size_t grains) { next_batch_.resize(grains, 0); }
  /// Adds a contact behind the others. Returns its lane, counted through all batches.
  std::int32_t add(const Contact& contact);
  /// Changes the contact of a lane; the grains stay the same two, maybe turned over.
  void set(std::int32_t lane, const Contact& contact);
  /// Empties a lane.
  void remove(std::int32_t lane);
  /// The contact of a lane, without its bodies.
  Contact contact(std::int32_t lane) const;

  void set_normal(std::int32_t lane, UnitVector normal) {
    batch(lane).normal_x[in_batch(lane)] = normal.x;
    batch(lane).normal_y[in_batch(lane)] = normal.y;
  }
  std::int32_t normal_impulse(std::int32_t lane) const {
    return batch(lane).impulse.normal[in_batch(lane)];
  }
  /// Velocity with which the contact is to part.
  std::int32_t& bounce(std::int32_t lane) { return batch(lane).bounce[in_batch(lane)]; }
  /// The contact of a lane as it is now.
  ContactState<std::int32_t> touching(std::int32_t lane, const std::vector<Body>& bodies) const;

  std::vector<Batch>& all() { return batches_; }

 private:
  static std::size_t in_batch(std::int32_t lane) { return static_cast<std::size_t>(lane) % kLanes; }
  Batch& batch(std::int32_t lane) { return batches_[static_cast<std::size_t>(lane) / kLanes]; }
  const Batch& batch(std::int32_t lane) const {
    return batches_[static_cast<std::size_t>(lane) / kLanes];
  }
  void set_numbers(std::int32_t lane, const Contact& contact, std::int32_t friction);

  const grains::State* grains_;  // pointers: batches are swapped
  const Rule* rule_;
  std::int32_t first_grain_;
  std::vector<Batch> batches_;
  std::vector<std::uint8_t> used_;         // lanes by batch
  std::vector<std::uint32_t> next_batch_;  // by grain: the first behind all of its contacts
  std::size_t first_not_full_ = 0;         // all batches before it are full
};

}  // namespace clca::contact
