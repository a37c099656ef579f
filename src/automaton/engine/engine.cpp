#include "automaton/engine/engine.hpp"

#include <algorithm>

namespace clca::automaton {

namespace {

/// Steps with fewer awake particles run on one thread.
constexpr std::size_t kParallelFrom = 4096;

}  // namespace

Engine::Engine(grains::State initial, const Rules& rules, const Options& options)
    : AutomatonMechanics(std::move(initial), rules),
      threads_(options.threads),
      parallel_from_(options.min_parallel_particles.value_or(kParallelFrom)),
      sleeping_(options.allow_sleeping),
      footprints_(world_.state, candidate_directions(rules)),
      reserved_(world_.state.lattice),
      contested_(world_.state.lattice),
      strips_(world_.state.lattice, footprints_, static_cast<std::size_t>(options.threads)),
      workers_(static_cast<std::size_t>(options.threads)),
      examined_(world_.state.particles.size()) {
  for (std::size_t strip = 0; strip < workers_.size(); ++strip) {
    StripWorker& worker = workers_[strip];
    worker.strip = strip;
    worker.proposals.resize(workers_.size());
    worker.work = strips_.empty_histogram();
  }
}

std::size_t Engine::move_particles() {
  begin_step();
  wake_changed();
  assign_strips();
  parallel::FirstFailure failure;
  if (in_parallel_) {
#pragma omp parallel num_threads(threads_)
    run_phases(failure);
  } else {
    run_phases(failure);
  }
  failure.rethrow();
  examined_ = 0;
  std::size_t moved = moved_.size();
  for (const StripWorker& worker : workers_) {
    examined_ += worker.examined_count;
    for (const Proposals& proposals : worker.proposals) {
      moved += proposals.falling.size() + proposals.sloping.size();
    }
    moved -= static_cast<std::size_t>(std::ranges::count_if(
        worker.queued_moves,
        [](const QueuedMove& turn) { return turn.proposal->outcome != ConflictOutcome::won; }));
  }
  nothing_moved_ = moved == 0 && overlapping_rested_;
  world_.changes.by_others = false;
  return moved;
}

void Engine::append_moved(std::vector<std::uint32_t>& ids) const {
  for (const StripWorker& worker : workers_) {
    for (const Proposals& proposals : worker.proposals) {
      for (const auto* list : {&proposals.falling, &proposals.sloping}) {
        for (const MoveProposal& proposal : *list) {
          if (proposal.move != grains::kRest) {
            ids.push_back(proposal.id);
          }
        }
      }
    }
  }
}

// Each phase reads what all threads have written in the one before.
void Engine::run_phases(parallel::FirstFailure& failure) {
  // 3. Awake particles choose a provisional direction.
  in_each_strip(failure, &Engine::propose);
  if (overlaps_) {
    move_overlapping();
  }
  // 4. Movers that nobody is in the way of move, whatever their position in the order. The others
  // have their turn in order.
  in_each_strip(failure, &Engine::reserve_sites);
  in_each_strip(failure, &Engine::find_conflicts);
  in_each_strip(failure, &Engine::commit);
#pragma omp single
  failure.guard([this] {
    if (!overlaps_) {
      decide_contests();
    }
  });
  in_each_strip(failure, &Engine::finish);
}

void Engine::in_each_strip(parallel::FirstFailure& failure, void (Engine::*phase)(StripWorker&)) {
  if (!in_parallel_) {
    (this->*phase)(workers_.front());
    return;
  }
#pragma omp for schedule(static, 1)
  for (StripWorker& worker : workers_) {
    failure.guard([&] { (this->*phase)(worker); });
  }
}

void Engine::begin_step() {
  overlaps_ = !world_.state.pushes.empty();
  for (StripWorker& worker : workers_) {
    std::swap(worker.awake, worker.awake_next);
    for (Proposals& proposals : worker.proposals) {
      proposals.falling.clear();
      proposals.sloping.clear();
    }
    worker.queued_moves.clear();
    worker.examined_count = 0;
  }
}

void Engine::wake_changed() {
  for (StripWorker& worker : workers_) {
    worker.awake.resize(world_.state.particles.size());
    worker.awake_next.resize(world_.state.particles.size());
  }
  for (const std::uint32_t id : world_.changes.changed_particles) {
    wake(id);
  }
  if (!sleeping_) {
    for (std::uint32_t id = 0; id < world_.state.particles.size(); ++id) {
      wake(id);
    }
  }
  for (const std::size_t index : world_.changes.vacated_sites) {
    if (!world_.occupancy.is_taken(index)) {
      wake_upstream(world_.state.lattice.site(index));
    }
  }
  world_.changes.changed_particles.clear();
  world_.changes.vacated_sites.clear();
}

// The owners of the sites from which a candidate move leads to the vacated one.
void Engine::wake_upstream(lattice::Site vacated) {
  const lattice::Lattice& lattice = world_.state.lattice;
  for (const lattice::Direction direction : active_.candidates()) {
    const lattice::Site from = vacated + unit(opposite(direction));
    const grains::Owner owner =
        lattice.contains(from) ? world_.occupancy.owner(lattice.index(from)) : grains::kFree;
    if (grains::is_particle(owner)) {
      wake(grains::particle_id(owner));
    }
  }
}

// Run by the worker of the strip that the particle was in in the last step.
void Engine::wake(std::uint32_t id) {
  const lattice::Site site = site_of(world_.state.particles[id]);
  workers_[in_parallel_ ? strips_.strip_of(site) : 0].awake.insert(id);
}

void Engine::assign_strips() {
  in_parallel_ = workers_.size() > 1 && examined_ >= parallel_from_ && !overlaps_;
  for (StripWorker& worker : workers_) {
    worker.inner_before = worker.inner;
  }
  records_work_ = false;
  if (!in_parallel_) {
    workers_.front().inner = strips_.all_columns();
    return;
  }
  constexpr std::uint64_t kRebalance = 16;  // steps; seldom, so that caches stay warm
  if (world_.state.step % kRebalance == 0) {
    std::vector<WorkHistogram*> histograms;
    for (StripWorker& worker : workers_) {
      histograms.push_back(&worker.work);
    }
    strips_.balance(histograms);
  }
  records_work_ = world_.state.step % kRebalance == kRebalance - 1;
  for (StripWorker& worker : workers_) {
    worker.inner = strips_.inner_interval(worker.strip);
  }
}

}  // namespace clca::automaton
