#include "contact/engine/engine.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "contact/engine/impact_slots.hpp"
#include "contact/rule/acceleration.hpp"
#include "contact/rule/cuts.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

/// Fewer grains are not worth a thread.
constexpr std::size_t kSplitFrom = 1024;

parallel::Threads threads_for(const grains::Options& options) {
  return {.count = options.threads, .min_per_thread = options.parallel_from.value_or(kSplitFrom)};
}

}  // namespace

Engine::Engine(State initial, const Parameters& parameters, const grains::Options& options,
               Profile* profile)
    : Steps(std::move(initial), parameters),
      state_(own_state()),
      rule_(rule()),
      threads_(threads_for(options)),
      profile_(profile),
      clock_(profile),
      batch_(fastest_functions()),
      finder_(box(), rule_, threads_),
      slots_(state_.grains.walls.size(),
             ContactFinder::max_groups(state_.grains.lattice, threads_)),
      mover_(state_, box(), threads_),
      first_grain_(slots_.batches().first_grain()),
      may_move_(threads_) {
  load();
}

void Engine::added(std::size_t first) {
  Steps::added(first);
  const std::size_t grains = state_.grains.particles.size();
  for (std::size_t id = first; id < grains; ++id) {
    changed_.push_back(static_cast<std::uint32_t>(id));
  }
  bodies_.resize(first_grain_ + grains);
  slots_.add_grains(grains);
}

void Engine::removing(std::uint32_t id) {
  Steps::removing(id);
  velocity(id) = {};
  changed_.push_back(id);
  mover_.remove_grain(id);
}

void Engine::reloaded() {
  write_back();
  Steps::reloaded();
  load();
}

void Engine::load() {
  load_bodies();
  finder_.load(state_.contacts, slots_);
  mover_.clear();
  look_at_all();
}

void Engine::load_bodies() {
  bodies_.resize(first_grain_);
  for (const Velocity<std::int32_t>& velocity : state_.velocities) {
    bodies_.push_back({velocity});
  }
}

void Engine::look_at_all() {
  changed_.resize(state_.grains.particles.size());
  std::iota(changed_.begin(), changed_.end(), 0U);
}

std::size_t Engine::move_grains() {
  written_back_ = false;
  clock_ = grains::PhaseClock(profile_);
  update_contacts();
  set_walls();
  bounce_new();
  collide();
  accelerate_all();
  clock_.end(&Profile::motion);
  sweep_contacts();
  advance_and_move();
  clock_.end(&Profile::moves);
  return moved_.size();
}

void Engine::update_contacts() {
  if (const lattice::Direction down = contact::down(state_.vessel); down != finder_.down()) {
    finder_.set_down(down);
    look_at_all();  // which one of two is the upper one may have changed
  }
  const std::size_t first_new = finder_.update(changed_, wall_velocities(state_), slots_);
  clock_.end(&Profile::contacts);
  new_slots_.clear();
  if (sorts_contacts(state_)) {
    finder_.sort(slots_, first_new, new_slots_);
  } else {
    new_slots_.resize(slots_.all().size() - first_new);
    std::iota(new_slots_.begin(), new_slots_.end(), static_cast<std::int32_t>(first_new));
  }
  state_.changed = false;
  for (const std::uint32_t id : changed_) {
    state_.grains.particles[id].previous = grains::kRest;
  }
  clock_.end(&Profile::order);
}

void Engine::set_walls() {
  for (std::size_t wall = 0; wall < state_.grains.walls.size(); ++wall) {
    for (std::size_t at = kFirstWallBody + wall; at < first_grain_;
         at += slots_.batches().fixed_body_count()) {
      bodies_[at].velocity = wall_velocity(state_, wall);
    }
  }
}

void Engine::bounce_new() {
  Batches& batches = slots_.batches();
  for (const std::int32_t slot : new_slots_) {
    const std::int32_t lane = slots_.at(slot).lane;
    batches.bounce(lane) =
        bounce(-separation_velocity(batches.touching(lane, bodies_)), rule_.restitution);
  }
}

void Engine::collide() {
  impacts_.clear();
  const auto bounce = [&](std::size_t slot) -> std::int32_t& {
    return slots_.batches().bounce(slots_.at(static_cast<std::int32_t>(slot)).lane);
  };
  for (const std::int32_t slot : new_slots_) {
    if (bounce(static_cast<std::size_t>(slot)) == 0) {
      continue;
    }
    std::vector<ImpactContact> impact = isolated_impact(slots_, slot);
    solve_impact(impact, state_.grains, rule_, velocity_of());
    for (const ImpactContact& one : impact) {
      bounce(one.at) = 0;
    }
    impacts_.insert(impacts_.end(), impact.begin(), impact.end());
  }
  std::sort(impacts_.begin(), impacts_.end(),
            [](const ImpactContact& one, const ImpactContact& other) { return one.at < other.at; });
}

void Engine::accelerate_all() {
  const Acceleration by =
      acceleration(state_.vessel, rule_.gravity, state_.grains.lattice.periodic());
  parallel::split(threads_, state_.grains.particles.size(),
                  [&, particles = std::span(state_.grains.particles), motions = grain_bodies()](
                      std::size_t /*part*/, std::size_t first, std::size_t last) {
                    for (std::size_t id = first; id < last; ++id) {
                      if (particles[id].present) {
                        accelerate(motions[id].velocity, particles[id].site(), by);
                      }
                    }
                  });
}

/// Calls work(batches, count) for each group of contacts, at the same time for those of a round.
template <class Work>
void Engine::in_rounds(bool backwards, Work work) {
  std::vector<Batch>& batches = slots_.batches().all();
  const std::vector<std::vector<Group>>& rounds = slots_.batches().rounds();
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const std::vector<Group>& round = rounds[backwards ? rounds.size() - 1 - i : i];
    parallel::split({.count = threads_.count}, round.size(),
                    [&](std::size_t /*part*/, std::size_t first, std::size_t last) {
                      for (std::size_t group = first; group < last; ++group) {
                        work(batches.data() + round[group].first, round[group].count);
                      }
                    });
  }
}

void Engine::sweep_contacts() {
  in_rounds(false, [&](Batch* batches, std::size_t count) {
    batch_.apply(batches, count, bodies_.data(), rule_.law.turns);
  });
  clock_.end(&Profile::warm_start);
  for (int i = 0; i < rule_.sweeps; ++i) {
    const bool backwards = i % 2 != 0;
    in_rounds(backwards, [&](Batch* batches, std::size_t count) {
      batch_.sweep(batches, count, bodies_.data(), rule_.law, backwards);
    });
  }
  for (const std::int32_t slot : new_slots_) {
    slots_.batches().bounce(slots_.at(slot).lane) = 0;
  }
  clock_.end(&Profile::sweeps);
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  std::atomic<bool> at_rest = true;
  may_move_.clear();
  parallel::split(threads_, state_.grains.particles.size(),
                  [&, particles = std::span(state_.grains.particles), motions = grain_bodies(),
                   remainders = std::span(state_.remainders)](std::size_t part, std::size_t first,
                                                              std::size_t last) {
                    bool part_rests = true;
                    std::vector<std::uint32_t>& near = may_move_.of(part);
                    near.resize(last - first);
                    std::size_t count = 0;
                    for (std::size_t id = first; id < last; ++id) {
                      if (!particles[id].present) {
                        continue;
                      }
                      part_rests =
                          contact::advance(remainders[id], motions[id].velocity,
                                           slots_.touches_anything(static_cast<std::uint32_t>(id)),
                                           slow) &&
                          part_rests;
                      near[count] = static_cast<std::uint32_t>(id);  // overwritten unless counted
                      count += squared(remainders[id]) > kNear * kNear ? 1 : 0;
                    }
                    near.resize(count);
                    if (!part_rests) {
                      at_rest = false;
                    }
                  });
  candidates_.clear();
  may_move_.for_each([&](std::uint32_t id) { candidates_.push_back(id); });
  clock_.end(&Profile::motion);
  std::vector<WallMove> walls = advance_walls(state_);
  mover_.move_all(finder_.down(), candidates_, walls);
  const SiteMoves& moves = mover_.moves();
  moved_ = moves.moved();
  cut_remainders(state_, moves, rule_, mover_.ids(), velocity_of());
  changed_ = moved_;
  changed_.insert(changed_.end(), moves.beside_walls().begin(), moves.beside_walls().end());
  end_step(state_, walls, moved_.empty(), at_rest);
}

void Engine::write_back() {
  if (written_back_) {
    return;
  }
  written_back_ = true;
  write_back_velocities();
  state_.contacts = contacts([](const Slot& /*slot*/) { return true; });
}

void Engine::write_back_velocities() {
  std::transform(bodies_.begin() + static_cast<std::ptrdiff_t>(first_grain_), bodies_.end(),
                 state_.velocities.begin(), [](const Body& body) { return body.velocity; });
}

std::vector<Contact> Engine::wall_contacts() const {
  return contacts([](const Slot& slot) { return !grains::is_particle(slot.other); });
}

/// Those that `chosen` returns true for, in order.
template <class Chosen>
std::vector<Contact> Engine::contacts(Chosen chosen) const {
  std::vector<Contact> result;
  auto impact = impacts_.begin();
  for (std::size_t at = 0; at < slots_.all().size(); ++at) {
    const Slot& slot = slots_.all()[at];
    const bool is_impact = impact != impacts_.end() && impact->at == at;
    if (slot.lane >= 0 && chosen(slot)) {
      result.push_back(slots_.content(static_cast<std::int32_t>(at)).contact);
      if (is_impact) {
        result.back().impact = impact->contact.impact;
      }
    }
    impact += is_impact ? 1 : 0;
  }
  return result;
}

}  // namespace clca::contact
