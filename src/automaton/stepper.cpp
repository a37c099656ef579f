#include "automaton/stepper.hpp"

#include <algorithm>

#include "automaton/phase_clock.hpp"
#include "automaton/retreat.hpp"

namespace clca::automaton {

namespace {

int tallest(const State& state) {
  int most = 0;
  for (const Kind& kind : state.kinds) {
    for (const lattice::Axial part : kind.shape.sites()) {
      most = std::max(most, length(part) + 1);
    }
  }
  return most;
}

}  // namespace

Stepper::Stepper(World& world, const Options& options)
    : world_(world),
      options_(options),
      rule_(world.state.rules, world.state.seed),
      order_(world.state.rules, world.state.seed),
      passive_(world),
      claims_(world.state.lattice),
      strips_(world.state, static_cast<std::size_t>(options.threads)),
      tallest_(tallest(world.state)),
      lanes_(static_cast<std::size_t>(options.threads)),
      looked_at_(world.state.particles.size()) {
  for (std::size_t strip = 0; strip < lanes_.size(); ++strip) {
    Lane& lane = lanes_[strip];
    lane.strip = strip;
    lane.found.resize(lanes_.size());
    lane.of_kind.resize(world.state.kinds.size());
    lane.load = strips_.no_load();
    lane.awake = strip == 0 ? &world.awake : &lane.own_awake;
  }
}

std::size_t Stepper::advance() {
  if (!options_.sleeping) {
    wake_all();
  }
  pushed_.clear();
  quiet_ = true;
  contested_moved_ = 0;
  in_parallel_ = parallel();
  for (Lane& lane : lanes_) {
    lane.falling.clear();
    lane.sloping.clear();
    lane.turns.clear();
    lane.looked_at = 0;
  }
  if (in_parallel_) {
    step_together();
  } else {
    step_alone();
  }
  looked_at_ = 0;
  std::size_t moved = pushed_.size() + contested_moved_;
  for (const Lane& lane : lanes_) {
    looked_at_ += lane.looked_at;
    moved += lane.falling.size() + lane.sloping.size() - lane.turns.size();
  }
  still_ = moved == 0 && quiet_;
  world_.changed = false;
  return moved;
}

void Stepper::wake_all() {
  for (std::uint32_t id = 0; id < world_.state.particles.size(); ++id) {
    world_.awake.insert(id);
  }
}

void Stepper::step_alone() {
  PhaseClock clock(options_.profile);
  Lane& lane = lanes_.front();
  const bool overlaps = !world_.state.pushes.empty();
  // Where nothing has moved or changed since all that overlap had last looked, they rest again.
  const bool engaged_may_move = overlaps && (!still_ || world_.changed || !options_.sleeping);
  lane.inner = strips_.inner();
  for (Lane& each : lanes_) {
    find_awake(each);
  }
  take_over(lane);
  std::vector<std::uint32_t>& ids = lane.found.front();
  if (overlaps) {
    std::erase_if(ids, [&](std::uint32_t id) { return world_.pushes.engaged(id); });
  }
  clock.end(&Profile::wake);
  look(lane, ids);
  if (engaged_may_move) {
    move_engaged(lane);
  }
  clock.end(&Profile::decide);
  claim(lane);
  contest_falling(lane);
  contest_sloping(lane);
  clock.end(&Profile::contest);
  move_uncontested(lane, lane.falling);
  move_uncontested(lane, lane.sloping);
  clock.end(&Profile::move);
  clear_claims(lane);
  move_contested();
  clock.end(&Profile::turns);
}

// Called by all threads, each takes a lane; all lanes are done when it returns.
template <class Work>
void Stepper::for_each_lane(Work work) {
#pragma omp for schedule(static, 1)
  for (Lane& lane : lanes_) {
    work(lane);
  }
}

// Each phase looks at what all threads have done in the one before.
void Stepper::step_together() {
  for (Lane& lane : lanes_) {
    lane.awake->resize(world_.state.particles.size());
    lane.inner = strips_.inner(lane.strip);
  }
  PhaseClock clock(options_.profile);
  const auto end = [&](double Profile::*phase) {
#pragma omp master
    clock.end(phase);
  };
#pragma omp parallel num_threads(options_.threads)
  {
    for_each_lane([this](Lane& lane) { find_awake(lane); });
    end(&Profile::wake);
    for_each_lane([this](Lane& lane) {
      take_over(lane);
      look(lane, lane.found[lane.strip]);
      claim(lane);
    });
    end(&Profile::decide);
    for_each_lane([this](Lane& lane) { contest_falling(lane); });
    end(&Profile::contest);
    for_each_lane([this](Lane& lane) {
      contest_sloping(lane);
      move_uncontested(lane, lane.falling);
      move_uncontested(lane, lane.sloping);
    });
    end(&Profile::move);
#pragma omp single nowait
    move_contested();
    for_each_lane([this](Lane& lane) { clear_claims(lane); });
    end(&Profile::turns);
  }
  constexpr std::uint64_t kSeldom = 16;  // what a thread has in its cache is to stay there
  if (world_.state.step % kSeldom == 0) {
    balance();
  }
}

void Stepper::balance() {
  std::vector<std::vector<std::uint32_t>*> loads;
  for (Lane& lane : lanes_) {
    loads.push_back(&lane.load);
  }
  strips_.balance(loads);
}

void Stepper::move_contested() {
  turns_.clear();
  for (const Lane& lane : lanes_) {
    turns_.insert(turns_.end(), lane.turns.begin(), lane.turns.end());
  }
  std::sort(turns_.begin(), turns_.end(),
            [](const Turn& left, const Turn& right) { return left.key < right.key; });
  for (const auto& [key, mover] : turns_) {
    const auto direction = static_cast<lattice::Direction>(mover->move);
    const Particle& particle = world_.state.particles[mover->id];
    if (mover->engaged && is_free(world_, mover->id, direction)) {
      world_.shift(mover->id, direction);
      ++contested_moved_;
    } else if (!mover->engaged && world_.is_free(particle, direction)) {
      carry(lanes_.front(), *mover);
      ++contested_moved_;
    } else {
      rest(mover->id);
    }
  }
}

void Stepper::rest(std::uint32_t id) {
  world_.state.particles[id].previous = kRest;
  world_.awake.insert(id);
}

}  // namespace clca::automaton
