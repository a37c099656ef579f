#pragma once
// Contacts put into batches.

#include <cstdint>
#include <vector>

#include "contact/engine/batch.hpp"

namespace clca::contact {

/// What a lane holds of a contact.
struct LaneContent {
  Contact contact = {};
  std::int32_t friction = 0;
  Pair pair = {};
};

/// Batches that share no grain with the other groups of their round: each group can be solved by
/// another thread.
struct Group {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Batches that give what a sweep over the contacts, in the order in which they were added, would
/// give: each contact is in a later batch than those before it that it shares a grain with.
class Batches {
 public:
  /// `groups`: how many there may be. Each has its own copies of the bodies that are not grains.
  Batches(std::size_t walls, std::size_t groups)
      : fixed_body_count_(kFirstWallBody + static_cast<std::int32_t>(walls)),
        first_grain_(fixed_body_count_ * static_cast<std::int32_t>(groups)) {}

  /// The body of the grain with id 0.
  std::size_t first_grain() const { return static_cast<std::size_t>(first_grain_); }
  /// A grain; or a wall or side, as they are in the first group.
  std::size_t body(grains::Owner owner) const;
  /// How many bodies of a group are not grains. Those of all groups come before the grains.
  std::size_t fixed_body_count() const { return static_cast<std::size_t>(fixed_body_count_); }

  /// Forgets all contacts and groups.
  void clear(std::size_t grains);
  /// There are more grains.
  void add_grains(std::size_t grains) { next_batch_.resize(grains, 0); }
  /// Begins a group; `after`: and a round.
  void begin_group(bool after);
  /// Adds a contact behind the others. Returns its lane, counted through all batches.
  std::int32_t add(const LaneContent& content);
  /// Changes what a lane holds; the grains stay the same two, maybe turned over.
  void set(std::int32_t lane, const LaneContent& content);
  /// Empties a lane.
  void remove(std::int32_t lane);
  /// The numbers of a lane, without its bodies.
  LaneContent content(std::int32_t lane) const;

  void set_normal(std::int32_t lane, UnitVector normal) {
    batch(lane).normal_x[in_batch(lane)] = normal.x;
    batch(lane).normal_y[in_batch(lane)] = normal.y;
  }
  /// Velocity with which the contact is to part.
  std::int32_t& bounce(std::int32_t lane) { return batch(lane).bounce[in_batch(lane)]; }
  /// The contact of a lane as it is now.
  ContactState<std::int32_t> touching(std::int32_t lane, const std::vector<Body>& bodies) const;

  std::vector<Batch>& all() { return batches_; }
  /// Groups by round, in the order of the rounds.
  const std::vector<std::vector<Group>>& rounds() const { return rounds_; }

 private:
  static std::size_t in_batch(std::int32_t lane) { return static_cast<std::size_t>(lane) % kLanes; }
  Batch& batch(std::int32_t lane) { return batches_[static_cast<std::size_t>(lane) / kLanes]; }
  const Batch& batch(std::int32_t lane) const {
    return batches_[static_cast<std::size_t>(lane) / kLanes];
  }

  std::int32_t fixed_body_count_;
  std::int32_t first_grain_;
  std::int32_t first_fixed_ = 0;  // of the group
  std::vector<std::vector<Group>> rounds_ = {{Group()}};
  std::vector<Batch> batches_;
  std::vector<std::uint8_t> used_;         // lanes by batch
  std::vector<std::uint32_t> next_batch_;  // by grain: the first behind all of its contacts
  std::size_t first_not_full_ = 0;         // all batches before it are full
};

}  // namespace clca::contact
