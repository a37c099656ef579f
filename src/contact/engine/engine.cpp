#include "contact/engine/engine.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

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
  new_lanes_.clear();
  if (sorts_contacts(state_)) {
    finder_.sort(slots_, first_new, new_lanes_);
  } else {
    for (const Slot& slot : slots_.all().subspan(first_new)) {
      new_lanes_.push_back(slot.lane);
    }
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
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) =
        bounce(-separation_velocity(slots_.batches().touching(lane, bodies_)), rule_.restitution);
  }
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
  for (const std::int32_t lane : new_lanes_) {
    slots_.batches().bounce(lane) = 0;
  }
  clock_.end(&Profile::sweeps);
}

void Engine::advance_and_move() {
  // No component exceeds half a site before the remainder itself does.
  constexpr std::int64_t kNear = kSpacing / 2 - 2;
  const std::int32_t slow = slow_speed(rule_);
  std::atomic<bool> quiet = true;
  may_move_.clear();
  parallel::split(threads_, state_.grains.particles.size(),
                  [&, particles = std::span(state_.grains.particles), motions = grain_bodies(),
                   remainders = std::span(state_.remainders)](std::size_t part, std::size_t first,
                                                              std::size_t last) {
                    bool at_rest = true;
                    std::vector<std::uint32_t>& near = may_move_.of(part);
                    near.resize(last - first);
                    std::size_t count = 0;
                    for (std::size_t id = first; id < last; ++id) {
                      if (!particles[id].present) {
                        continue;
                      }
                      at_rest =
                          contact::advance(remainders[id], motions[id].velocity,
                                           slots_.touches_anything(static_cast<std::uint32_t>(id)),
                                           slow) &&
                          at_rest;
                      near[count] = static_cast<std::uint32_t>(id);  // overwritten unless counted
                      count += squared(remainders[id]) > kNear * kNear ? 1 : 0;
                    }
                    near.resize(count);
                    if (!at_rest) {
                      quiet = false;
                    }
                  });
  candidates_.clear();
  may_move_.for_each([&](std::uint32_t id) { candidates_.push_back(id); });
  clock_.end(&Profile::motion);
  std::vector<WallMove> walls = advance_walls(state_);
  mover_.move_all(finder_.down(), candidates_, walls);
  const SiteMoves& moves = mover_.moves();
  moved_ = moves.moved();
  cut_remainders(state_, moves, rule_, mover_.ids(),
                 [&](grains::Owner body) -> Velocity<std::int32_t>& {
                   return bodies_[slots_.batches().body(body)].velocity;
                 });
  changed_ = moved_;
  changed_.insert(changed_.end(), moves.beside_walls().begin(), moves.beside_walls().end());
  end_step(state_, walls, quiet && moved_.empty());
}

void Engine::write_back() {
  if (written_back_) {
    return;
  }
  written_back_ = true;
  write_back_velocities();
  state_.contacts.clear();
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.all().size()); ++at) {
    if (slots_.at(at).lane >= 0) {
      state_.contacts.push_back(slots_.content(at).contact);
    }
  }
}

void Engine::write_back_velocities() {
  std::transform(bodies_.begin() + static_cast<std::ptrdiff_t>(first_grain_), bodies_.end(),
                 state_.velocities.begin(), [](const Body& body) { return body.velocity; });
}

std::vector<Contact> Engine::wall_contacts() const {
  std::vector<Contact> result;
  for (std::int32_t at = 0; at < static_cast<std::int32_t>(slots_.all().size()); ++at) {
    if (slots_.at(at).lane >= 0 && !grains::is_particle(slots_.at(at).other)) {
      result.push_back(slots_.content(at).contact);
    }
  }
  return result;
}

}  // namespace clca::contact
