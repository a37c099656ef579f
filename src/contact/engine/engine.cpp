#include "contact/engine/engine.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "contact/rule/acceleration.hpp"
#include "contact/rule/moves.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

std::vector<std::uint32_t> sorted_once(std::vector<std::uint32_t> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

Engine::Engine(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
               const grains::WallEdges& edges, const Rule& rule, Profile* profile)
    : state_(state),
      occupancy_(occupancy),
      footprints_(footprints),
      edges_(edges),
      rule_(rule),
      profile_(profile),
      clock_(profile),
      batch_(fastest_functions()),
      finder_(state.grains, occupancy, footprints, rule),
      slots_(state.grains.walls.size()),
      first_grain_(kFirstWallBody + state.grains.walls.size()) {
  reload();
}

void Engine::add_grains() {
  const std::size_t grains = state_.grains.particles.size();
  for (std::size_t id = bodies_.size() - first_grain_; id < grains; ++id) {
    changed_.push_back(static_cast<std::uint32_t>(id));
  }
  bodies_.resize(first_grain_ + grains);
  slots_.add_grains(grains);
}

void Engine::remove_grain(std::uint32_t id) {
  velocity(id) = {};
  changed_.push_back(id);
}

void Engine::reload() {
  bodies_.assign(first_grain_, {});
  for (const Velocity<std::int32_t>& velocity : state_.velocities) {
    bodies_.push_back({velocity});
  }
  finder_.load(state_.contacts, slots_);
  look_at_all();
}

void Engine::look_at_all() {
  changed_.resize(state_.grains.particles.size());
  std::iota(changed_.begin(), changed_.end(), 0U);
}

void Engine::step() {
  clock_ = grains::PhaseClock(profile_);
  update_contacts();
  accelerate_all();
  clock_.end(&Profile::motion);
  sweep_contacts();
  advance_and_move();
  clock_.end(&Profile::moves);
}

void Engine::update_contacts() {
  if (const lattice::Direction down = contact::down(state_.vessel); down != finder_.down()) {
    finder_.set_down(down);
    look_at_all();  // which one of two is the upper one may have changed
  }
  const std::size_t first_new = finder_.update(changed_, slots_);
  new_lanes_.clear();
  for (const Slot& slot : slots_.all().subspan(first_new)) {
    new_lanes_.push_back(slot.lane);
  }
  clock_.end(&Profile::contacts);
  if (sorts_contacts(state_)) {
    finder_.sort(slots_, new_lanes_);
  }
  state_.changed = false;
  for (const std::uint32_t id : changed_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
  clock_.end(&Profile::order);
}

void Engine::accelerate_all() {
  const Acceleration by =
      acceleration(state_.vessel, rule_.gravity, state_.grains.lattice.periodic());
  for (std::size_t id = 0; id < state_.grains.particles.size(); ++id) {
    if (const grains::Particle& grain = state_.grains.particles[id]; grain.present) {
      accelerate(velocity(id), grain.site(), by);
    }
  }
}

void Engine::sweep_contacts() {
  for (std::size_t wall = 0; wall < state_.grains.walls.size(); ++wall) {
    bodies_[kFirstWallBody + wall].velocity = wall_velocity(state_, wall);
  }
  std::vector<Batch>& batches = slots_.batches().all();
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) =
        bounce(-separation_velocity(slots_.batches().touching(lane, bodies_)), rule_.restitution);
  }
  batch_.apply(batches.data(), batches.size(), bodies_.data(), rule_.turning.turns);
  clock_.end(&Profile::warm_start);
  for (int i = 0; i < rule_.sweeps; ++i) {
    batch_.sweep(batches.data(), batches.size(), bodies_.data(), rule_.turning, i % 2 != 0);
  }
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) = 0;
  }
  clock_.end(&Profile::sweeps);
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  bool quiet = true;
  candidates_.clear();
  for (std::uint32_t id = 0; id < state_.grains.particles.size(); ++id) {
    if (!state_.grains.particles[id].present) {
      continue;
    }
    quiet = advance(state_.remainders[id], velocity(id), slow) && quiet;
    if (squared(state_.remainders[id]) > kNear * kNear) {
      candidates_.push_back(id);
    }
  }
  clock_.end(&Profile::motion);
  std::vector<WallMove> walls = advance_walls(state_);
  Moves moves =
      move_all(state_, occupancy_, footprints_, edges_, finder_.down(), candidates_, walls);
  moved_ = sorted_once(std::move(moves.moved));
  for (const std::uint32_t id : candidates_) {
    cut(state_.remainders[id]);
  }
  for (const std::uint32_t id : moved_) {  // also those that walls have pushed
    if (!std::binary_search(candidates_.begin(), candidates_.end(), id)) {
      cut(state_.remainders[id]);
    }
  }
  moves.beside_walls.insert(moves.beside_walls.end(), moved_.begin(), moved_.end());
  changed_ = sorted_once(std::move(moves.beside_walls));
  end_step(state_, walls, quiet && moved_.empty());
}

void Engine::write_back() {
  std::transform(bodies_.begin() + static_cast<std::ptrdiff_t>(first_grain_), bodies_.end(),
                 state_.velocities.begin(), [](const Body& body) { return body.velocity; });
  state_.contacts.clear();
  for (const Slot& slot : slots_.all()) {
    if (slot.lane >= 0) {
      state_.contacts.push_back({.upper = slot.upper,
                                 .other = slot.other,
                                 .normal = slots_.batches().normal(slot.lane),
                                 .impulse = slots_.batches().impulse(slot.lane)});
    }
  }
}

}  // namespace clca::contact
