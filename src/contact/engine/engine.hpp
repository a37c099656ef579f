#pragma once
// Steps as Reference gives them, at a cost that follows what changes.

#include <cstdint>
#include <utility>
#include <vector>

#include "clca/grains/model.hpp"
#include "contact/engine/contact_finder.hpp"
#include "contact/engine/contact_slots.hpp"
#include "contact/engine/mover.hpp"
#include "contact/engine/small_groups.hpp"
#include "contact/rule/impacts.hpp"
#include "contact/rule/step.hpp"
#include "grains/internal/phase_clock.hpp"

namespace clca::contact {

class Engine final : public Steps {
 public:
  /// With the motion of a grain and its contacts in the state.
  static constexpr double kGrainBytes =
      sizeof(Velocity<std::int32_t>) + sizeof(Vector) + sizeof(lattice::Axial) +
      ContactSlots::kGrainBytes + ContactFinder::kGrainBytes + SmallGroups::kGrainBytes +
      Mover::kGrainBytes + sizeof(Body) +
      grains::kListRoom * (3 * sizeof(std::uint32_t) +
                           kContactsPerGrain * (sizeof(Contact) + sizeof(std::int32_t)));

  Engine(State initial, const Parameters& parameters, grains::PhaseTimes* phase_times);

  void write_back() override;
  void write_back_velocities() override;
  void added(std::size_t first) override;
  std::vector<std::uint32_t> moved() const override { return moved_; }
  void removing(std::uint32_t id) override;
  void reloaded() override;

 private:
  std::size_t move_grains() override;
  std::vector<Contact> wall_contacts() const override;
  template <class Chosen>
  std::vector<Contact> contacts(Chosen chosen) const;
  Velocity<std::int32_t>& velocity(std::size_t id) { return bodies_[first_grain_ + id].velocity; }
  VelocityOf velocity_of() {
    return [this](grains::Owner body) -> Velocity<std::int32_t>& {
      return bodies_[static_cast<std::size_t>(slots_.batches().body(body))].velocity;
    };
  }
  void load();
  void load_bodies();
  void update_contacts();
  void set_walls();
  void bounce_loose();
  void collide();
  void accelerate_all();
  void sweep_contacts();
  void finish_groups();
  void advance_and_move();
  void look_at_all();

  State& state_;
  const Rule& rule_;
  grains::PhaseTimes* phase_times_;
  grains::PhaseClock clock_;  // of this step
  BatchFunctions batch_;
  ContactFinder finder_;
  ContactSlots slots_;
  SmallGroups groups_;
  Mover mover_;
  std::size_t first_grain_;  // its body
  std::vector<Body> bodies_;
  std::vector<std::int32_t> bouncing_;       // slots of contacts that bounce in this step
  std::vector<std::vector<Touch>> touches_;  // the contacts of the small groups
  // Slots and impulses of the impacts of this step, in the order of the slots.
  std::vector<std::pair<std::int32_t, Impulse<std::int32_t>>> impacts_;
  std::vector<std::uint32_t> moved_;       // in the last step, once each
  std::vector<std::uint32_t> changed_;     // grains that may touch other bodies than they did
  std::vector<std::uint32_t> candidates_;  // grains whose remainder may ask for a move
  bool written_back_ = true;
};

}  // namespace clca::contact
