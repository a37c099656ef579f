#pragma once
// Steps as reference_step() gives them, at a cost that follows what changes.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/profile.hpp"
#include "contact/engine/contact_finder.hpp"
#include "contact/engine/contact_slots.hpp"
#include "contact/engine/mover.hpp"
#include "contact/rule/step.hpp"
#include "grains/internal/phase_clock.hpp"

namespace clca::contact {

class Engine {
 public:
  /// All outlive the engine. While it is there, velocities and contacts of the state are as they
  /// were at write_back() last. `profile` may be null.
  Engine(State& state, grains::OccupancyTable& occupancy, const grains::FootprintTable& footprints,
         const grains::WallEdges& edges, const Rule& rule, const parallel::Threads& threads,
         Profile* profile);

  /// There are new grains, which are at rest.
  void add_grains();
  /// A grain has been taken away.
  void remove_grain(std::uint32_t id);
  /// Takes velocities and contacts from the state, of which anything may have changed.
  void reload();

  /// Carries out a step but for sources and outlets.
  void step();
  const Velocity<std::int32_t>& velocity_of(std::size_t id) const {
    return bodies_[first_grain_ + id].velocity;
  }
  /// Those that moved in the last step, once each.
  std::span<const std::uint32_t> moved() const { return moved_; }
  /// Sets velocities and contacts of the state.
  void write_back();
  void write_back_velocities();
  /// Those with walls and sides.
  std::vector<Contact> wall_contacts() const;

 private:
  Velocity<std::int32_t>& velocity(std::size_t id) { return bodies_[first_grain_ + id].velocity; }
  std::span<Body> grain_bodies() { return std::span(bodies_).subspan(first_grain_); }
  void load_bodies();
  void update_contacts();
  void set_walls();
  void bounce_new();
  void accelerate_all();
  void sweep_contacts();
  template <class Work>
  void in_rounds(bool backwards, Work work);
  void advance_and_move();
  void look_at_all();

  State& state_;
  const Rule& rule_;
  parallel::Threads threads_;
  Profile* profile_;
  grains::PhaseClock<Profile> clock_;  // of this step
  BatchFunctions batch_;
  ContactFinder finder_;
  ContactSlots slots_;
  Mover mover_;
  std::size_t first_grain_;  // its body
  std::vector<Body> bodies_;
  std::vector<std::int32_t> new_lanes_;  // lanes of contacts that are new in this step
  std::vector<std::uint32_t> moved_;     // in the last step
  std::vector<std::uint32_t> changed_;   // grains that may touch other bodies than they did
  parallel::PartLists<std::uint32_t> may_move_;
  std::vector<std::uint32_t> candidates_;  // grains whose remainder may ask for a move
};

}  // namespace clca::contact
