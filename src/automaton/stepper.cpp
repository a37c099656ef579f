#include "automaton/stepper.hpp"

#include <algorithm>

#include "automaton/retreat.hpp"
#include "clca/grains/phase_clock.hpp"

namespace clca::automaton {

namespace {

int tallest(const grains::State& state) {
  int most = 0;
  for (const grains::Kind& kind : state.kinds) {
    for (const lattice::Axial part : kind.shape.sites()) {
      most = std::max(most, length(part) + 1);
    }
  }
  return most;
}

void clear(std::vector<Movers>& all) {
  for (Movers& movers : all) {
    movers.falling.clear();
    movers.sloping.clear();
  }
}

}  // namespace

Stepper::Stepper(World& world, const Options& options)
    : world_(world),
      options_(options),
      rule_(world.rules, world.state.seed),
      order_(world.rules, world.state.seed),
      passive_(world),
      claims_(world.state.lattice),
      strips_(world.state.lattice, world.footprints, static_cast<std::size_t>(options.threads)),
      tallest_(tallest(world.state)),
      lanes_(static_cast<std::size_t>(options.threads)),
      looked_at_(world.state.particles.size()) {
  for (std::size_t strip = 0; strip < lanes_.size(); ++strip) {
    Lane& lane = lanes_[strip];
    lane.strip = strip;
    lane.movers.resize(lanes_.size());
    lane.movers_before.resize(lanes_.size());
    lane.of_kind.resize(world.state.kinds.size());
    lane.load = strips_.no_load();
  }
}

std::size_t Stepper::advance() {
  if (!options_.sleeping) {
    wake_all();
  }
  begin_step();
  take_woken();
  in_parallel_ = parallel();
  for (Lane& lane : lanes_) {
    lane.inner_before = lane.inner;
  }
  if (in_parallel_) {
    step_together();
  } else {
    step_alone();
  }
  looked_at_ = 0;
  std::size_t moved = pushed_.size();
  for (const Lane& lane : busy()) {
    looked_at_ += lane.looked_at;
    for (const Movers& movers : lane.movers) {
      moved += movers.falling.size() + movers.sloping.size();
    }
    moved -= static_cast<std::size_t>(
        std::count_if(lane.turns.begin(), lane.turns.end(),
                      [](const Turn& turn) { return turn.mover->standing != Standing::won; }));
  }
  still_ = moved == 0 && quiet_;
  world_.changed = false;
  return moved;
}

void Stepper::begin_step() {
  pushed_.clear();
  quiet_ = true;
  const bool hold = records_hold_ && !world_.changed && world_.state.pushes.empty();
  const std::size_t busy_now = busy().size();
  for (Lane& lane : std::span(lanes_).first(std::max(busy_before_, busy_now))) {
    std::swap(lane.movers, lane.movers_before);
    std::swap(lane.awake, lane.waking);
    clear(lane.movers);
    lane.turns.clear();
    lane.open.clear();
    lane.looked_at = 0;
    if (!hold) {
      clear(lane.movers_before);
      lane.awake.list_marked();
    }
  }
  busy_before_ = busy_now;
  records_hold_ = world_.state.pushes.empty();
}

void Stepper::wake_all() {
  for (std::uint32_t id = 0; id < world_.state.particles.size(); ++id) {
    world_.awake.insert(id);
  }
}

// Those woken by something else than moves; each goes where its strip was in the step before.
void Stepper::take_woken() {
  const grains::State& state = world_.state;
  for (Lane& lane : busy()) {
    lane.awake.resize(state.particles.size());
    lane.waking.resize(state.particles.size());
  }
  if (!in_parallel_ && lanes_.front().awake.empty()) {
    std::swap(lanes_.front().awake, world_.awake);
    world_.awake.resize(state.particles.size());
    return;
  }
  for (const std::uint32_t id : world_.awake.listed()) {
    const lattice::Site site = site_of(state.particles[id]);
    lanes_[in_parallel_ ? strips_.of(site) : 0].awake.insert(id);
  }
  world_.awake.clear();
}

void Stepper::step_alone() {
  grains::PhaseClock clock(options_.profile);
  Lane& lane = lanes_.front();
  const bool overlaps = !world_.state.pushes.empty();
  // Where nothing has moved or changed since all that overlap had last looked, they rest again.
  const bool engaged_may_move = overlaps && (!still_ || world_.changed || !options_.sleeping);
  lane.inner = strips_.inner();
  notes_load_ = false;
  look(lane);
  for (Lane& each : lanes_) {
    forget_awake(each);
  }
  if (engaged_may_move) {
    move_engaged(lane);
  }
  clock.end(&Profile::decide);
  claim(lane);
  contest_falling(lane);
  clock.end(&Profile::contest);
  move(lane);
  clock.end(&Profile::move);
  if (overlaps) {
    give_turns_in_place(lane);
  } else {
    give_own_turns(lane);
    give_open_turns();
  }
  end_turns(lane);
  clock.end(&Profile::turns);
}

// Called by all threads, each takes a lane; all lanes are done when it returns.
template <class Work>
void Stepper::for_each_lane(parallel::FirstFailure& failure, Work work) {
#pragma omp for schedule(static, 1)
  for (Lane& lane : lanes_) {
    failure.guard([&] { work(lane); });
  }
}

// Each phase looks at what all threads have done in the one before.
void Stepper::step_together() {
  constexpr std::uint64_t kSeldom = 16;  // what a thread has in its cache is to stay there
  if (world_.state.step % kSeldom == 0) {
    balance();
  }
  notes_load_ = world_.state.step % kSeldom == kSeldom - 1;
  for (Lane& lane : lanes_) {
    lane.inner = strips_.inner(lane.strip);
    lane.awake.resize(world_.state.particles.size());
    lane.waking.resize(world_.state.particles.size());
  }
  grains::PhaseClock clock(options_.profile);
  const auto end = [&](double Profile::*phase) {
#pragma omp master
    clock.end(phase);
  };
  parallel::FirstFailure failure;
#pragma omp parallel num_threads(options_.threads)
  {
    for_each_lane(failure, [this](Lane& lane) { look(lane); });
    end(&Profile::decide);
    for_each_lane(failure, [this](Lane& lane) {
      forget_awake(lane);
      mark_found_by_others(lane);
      claim(lane);
    });
    for_each_lane(failure, [this](Lane& lane) { contest_falling(lane); });
    end(&Profile::contest);
    for_each_lane(failure, [this](Lane& lane) {
      move(lane);
      give_own_turns(lane);
    });
    end(&Profile::move);
#pragma omp single
    failure.guard([this] { give_open_turns(); });
    for_each_lane(failure, [this](Lane& lane) { end_turns(lane); });
    end(&Profile::turns);
  }
  failure.rethrow();
}

void Stepper::balance() {
  std::vector<Load*> loads;
  for (Lane& lane : lanes_) {
    loads.push_back(&lane.load);
  }
  strips_.balance(loads);
}

}  // namespace clca::automaton
