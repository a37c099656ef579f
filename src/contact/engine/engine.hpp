#pragma once
// Steps as ReferenceMechanics gives them, at a cost that follows what changes.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "clca/grains/model.hpp"
#include "contact/engine/contacts.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

/// Moves of one step as move_all() gives them, at a cost that follows what moves.
///
/// A grain whose way is not free waits until what is in its way has moved, maybe for many steps:
/// in between it is not looked at. It may wait in several directions, in each for one other body.
class Mover {
 public:
  /// Bytes for a grain.
  static constexpr double kBytesPerGrain =
      sizeof(std::uint8_t) + (3 * lattice::kDirectionCount + 1) * sizeof(std::int32_t) +
      sizeof(std::uint64_t) + grains::kListCapacityRatio * 4 * sizeof(std::uint32_t);

  /// Both arguments must outlive the mover.
  Mover(State& state, grains::Box& box) : state_(state), moves_(state, box) {}

  /// Nobody waits any more: there are other grains, or walls.
  void clear();
  /// A grain has been taken away.
  void remove_grain(std::uint32_t id);

  /// move_all() for `ids`, which are all grains that are far enough from their sites to want a
  /// move. Their order does not matter.
  void move_all(lattice::Direction down, std::span<const std::uint32_t> ids,
                std::span<WallMove> walls);
  /// The moves of the last move_all().
  const SiteMoves& site_moves() const { return moves_; }
  /// The grains tried by the last move_all(): `ids`, and those that walls have pushed.
  std::span<const std::uint32_t> tried_ids() const { return ids_; }

 private:
  // A grain and a direction in which it may wait are a number: kDirectionCount x id + direction.
  using Waiting = std::int32_t;
  static constexpr Waiting kNone = -1;
  static Waiting waiting(std::uint32_t id, lattice::Direction direction) {
    return static_cast<Waiting>(std::size_t{id} * lattice::kDirectionCount +
                                lattice::index_of(direction));
  }
  // Numbers of obstacles, for which grains wait: all walls and the border are one, each grain one.
  static constexpr std::size_t kWalls = 0;
  static std::size_t obstacle(std::uint32_t id) { return id + 1; }

  bool waits(std::uint32_t id, lattice::Direction direction) const {
    return (waiting_directions_[id] >> lattice::index_of(direction) & 1U) != 0;
  }
  void move(lattice::Direction direction, std::span<WallMove> walls);
  void move(std::span<const std::uint32_t> ids, lattice::Direction direction);
  void end_waits(std::span<const std::uint32_t> ids, lattice::Direction direction);
  bool has_ring(lattice::Direction direction);
  bool move_at_once(lattice::Direction direction);
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls);
  bool wait_if_blocked(std::uint32_t id, lattice::Direction direction);
  void stop_waiting(Waiting entry);
  void wake(std::size_t obstacle, lattice::Direction direction);

  State& state_;
  SiteMoves moves_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint32_t> ready_;              // grains to be tried
  std::vector<std::uint32_t> blocked_;            // those that have waited in this direction
  std::vector<std::uint8_t> waiting_directions_;  // by id, as bits
  std::vector<Waiting> first_waiting_;            // by obstacle
  std::vector<std::uint32_t> obstacle_;           // by Waiting
  std::vector<Waiting> next_waiting_;             // by Waiting: at the same obstacle
  std::vector<Waiting> previous_waiting_;         // likewise; of the first one -1 - obstacle
  std::vector<std::uint64_t> walk_of_;            // by id: the last walk that came by
  std::uint64_t walks_ = 0;                       // of has_ring(), so far
};

class Engine final : public ContactMechanics {
 public:
  /// Bytes for a grain, with its motion and its contacts in the state.
  static constexpr double kBytesPerGrain =
      sizeof(Velocity<>) + sizeof(Vector) + sizeof(lattice::Axial) + ContactSlots::kBytesPerGrain +
      ContactFinder::kBytesPerGrain + SmallGroups::kBytesPerGrain + Mover::kBytesPerGrain +
      sizeof(AlignedVelocity) +
      grains::kListCapacityRatio * (3 * sizeof(std::uint32_t) +
                                    kContactsPerGrain * (sizeof(Contact) + sizeof(std::int32_t)));

  Engine(State initial, const Parameters& parameters);

  void write_contacts_back() override;
  void on_added(std::size_t first) override;
  void on_removing(std::uint32_t id) override;
  void on_reloaded() override;

 private:
  void move_grains() override;
  std::vector<Contact> wall_contacts() const override { return contacts(false); }
  std::vector<Contact> contacts(bool with_grains) const;
  Contact contact(std::int32_t at) const;
  Velocity<>& velocity(std::size_t id) { return bodies_[slots_.first_grain_body() + id].velocity; }
  void load();
  void mark_all_changed();
  void update_contacts();
  void bounce_unloaded_contacts();
  template <class Solve>
  void for_each_group(Solve solve);
  void sweep_contacts();
  void advance_and_move();

  PassFunction carry_out_pass_;
  ContactFinder finder_;
  ContactSlots slots_;
  SmallGroups groups_;
  Mover mover_;
  std::vector<AlignedVelocity> bodies_;
  BodyVelocities body_velocities_;             // of bodies_
  std::vector<std::int32_t> bouncing_;         // slots of contacts that bounce in this step
  std::map<std::int32_t, Impulse<>> impacts_;  // of this step, by slot
  std::vector<std::uint32_t> changed_;         // grains that may touch other bodies than they did
  std::vector<std::uint32_t> candidates_;      // grains whose remainder may ask for a move
  bool written_back_ = true;                   // the contacts to the state
};

}  // namespace clca::contact
