#pragma once
// Steps as reference_step() gives them, at a cost that follows what changes.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/engine/contact_finder.hpp"
#include "contact/engine/contact_slots.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

class Engine {
 public:
  /// All outlive the engine. Between steps others may change the state, and say so (see below).
  Engine(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
         const Rule& rule);

  /// Grains from `first` on are new.
  void add_grains(std::size_t first);
  /// A grain has been taken away.
  void remove_grain(std::uint32_t id) { moved_.push_back(id); }
  /// Anything may have changed: all is looked at anew. Contacts are taken from the state.
  void reload();

  /// Carries out a step but for sources and outlets. The contacts of the state are as they were
  /// until write_contacts().
  void step();
  /// Those that moved in the last step, once each.
  std::span<const std::uint32_t> moved() const { return moved_; }
  /// Sets the contacts of the state to those of the last step.
  void write_contacts();

 private:
  void update_contacts();
  template <bool kTurns>
  void accelerate();
  template <bool kTurns>
  void sweep();
  void advance_and_move();
  Touching bodies(const Slot& slot) {
    return {.upper = state_.motions[slot.contact.upper],
            .other = grains::is_particle(slot.contact.other)
                         ? state_.motions[static_cast<std::size_t>(slot.contact.other)]
                         : wall_,
            .normal = slot.normal,
            .pair = *slot.pair};
  }

  State& state_;
  grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  const Rule& rule_;
  ContactFinder finder_;
  ContactSlots slots_;
  std::size_t first_new_ = 0;  // slot
  Motion wall_;
  std::vector<std::uint32_t> moved_;  // since contacts were last brought in line
  std::vector<std::uint32_t> far_;    // grains whose remainder may ask for a move
};

}  // namespace clca::contact
