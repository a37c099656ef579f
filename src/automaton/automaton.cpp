#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "automaton/deposit.hpp"
#include "automaton/fill.hpp"
#include "automaton/source.hpp"
#include "automaton/stepper.hpp"
#include "automaton/wall_mover.hpp"
#include "automaton/wall_presence.hpp"

namespace clca::automaton {

namespace {

State valid(State state, const Options& options) {
  if (options.threads < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
  check_valid(state);
  return state;
}

void check_counts(const State& state, std::span<const std::size_t> counts) {
  std::size_t species = 0;
  for (const Kind& kind : state.kinds) {
    species = std::max<std::size_t>(species, kind.species + 1U);
  }
  if (counts.size() != species) {
    throw std::invalid_argument("a fill needs one count for each species");
  }
}

}  // namespace

class Automaton::Impl {
 public:
  Impl(State initial, Options options)
      : world(valid(std::move(initial), options)), stepper(world, options), walls(world.state) {}

  /// Carries out a change; nothing more is changed after one that has failed halfway.
  template <class Change>
  auto whole(Change change) {
    if (half_changed_) {
      throw std::logic_error("an automaton cannot go on after a change that failed");
    }
    half_changed_ = true;
    auto result = change();
    half_changed_ = false;
    return result;
  }

  StepReport step() {
    StepReport report;
    State& state = world.state;
    walls.advance(world, report);
    const std::size_t before = state.particles.size();
    const SourceReport sources = run_sources(state, world.occupancy);
    report.emitted = state.particles.size() - before;
    world.welcome_from(before);
    report.moved = stepper.advance();
    report.looked_at = stepper.looked_at();
    if (!state.outlets.empty()) {
      std::size_t& removed = report.removed;
      stepper.for_each_moved([&](std::uint32_t id) { removed += discharge(id) ? 1U : 0U; });
      for (const std::uint32_t id : world.carried) {
        removed += discharge(id) ? 1U : 0U;
      }
      for (std::size_t id = before; id < state.particles.size(); ++id) {
        removed += discharge(static_cast<std::uint32_t>(id)) ? 1U : 0U;
      }
    }
    report.settled = report.moved == 0 && report.emitted == 0 && !sources.waiting &&
                     report.walls_moved == 0 && stepper.was_quiet() && walls.is_still(world);
    WallMover::end_step(world, report.moved > 0);
    ++state.step;
    return report;
  }

  /// `place` puts the particles into a region: fill_region or deposit_in.
  template <class Place>
  FillResult fill(Place place, const lattice::Rectangle& region,
                  std::span<const std::size_t> counts) {
    const std::size_t before = world.state.particles.size();
    FillResult result = place(world.state, world.occupancy, region, counts);
    world.welcome_from(before);
    for (std::size_t id = before; id < world.state.particles.size(); ++id) {
      discharge(static_cast<std::uint32_t>(id));
    }
    return result;
  }

  World world;
  Stepper stepper;
  WallMover walls;

 private:
  bool half_changed_ = false;

  /// Removes the particle if it lies wholly inside an outlet.
  bool discharge(std::uint32_t id) {
    State& state = world.state;
    const Particle& particle = state.particles[id];
    if (!particle.present) {
      return false;
    }
    const auto outlet =
        std::find_if(state.outlets.begin(), state.outlets.end(),
                     [&](const Outlet& o) { return lies_inside(state, particle, o.region); });
    if (outlet == state.outlets.end()) {
      return false;
    }
    ++outlet->particles;
    outlet->sites += state.shape(particle).size();
    world.take_away(id);
    return true;
  }
};

Automaton::Automaton(State state, Options options)
    : impl_(std::make_unique<Impl>(std::move(state), options)) {}
Automaton::~Automaton() = default;
Automaton::Automaton(Automaton&&) noexcept = default;
Automaton& Automaton::operator=(Automaton&&) noexcept = default;

const State& Automaton::state() const {
  return impl_->world.state;
}
const Occupancy& Automaton::occupancy() const {
  return impl_->world.occupancy;
}
StepReport Automaton::step() {
  return impl_->whole([&] { return impl_->step(); });
}

FillResult Automaton::fill(const lattice::Rectangle& region, std::span<const std::size_t> counts) {
  check_counts(state(), counts);
  lattice::check(region);
  return impl_->whole([&] { return impl_->fill(fill_region, region, counts); });
}

FillResult Automaton::deposit(const lattice::Rectangle& region,
                              std::span<const std::size_t> counts) {
  check_counts(state(), counts);
  lattice::check(region);
  if (state().rules.gravity != lattice::Direction::down) {
    throw std::invalid_argument("particles are deposited along a gravity that points down");
  }
  return impl_->whole([&] { return impl_->fill(deposit_in, region, counts); });
}

void Automaton::remove_wall(std::size_t wall) {
  static_cast<void>(state().walls.at(wall));
  impl_->whole([&] {
    automaton::remove_wall(impl_->world, wall);
    return true;
  });
}

bool Automaton::insert_wall(std::size_t wall) {
  static_cast<void>(state().walls.at(wall));
  return impl_->whole([&] { return automaton::insert_wall(impl_->world, wall); });
}

void Automaton::set_motion(std::size_t wall, bool active) {
  Wall& moving = impl_->world.state.walls.at(wall);
  if (!moving.motion) {
    throw std::invalid_argument("a wall without motion cannot be set in motion");
  }
  moving.travel.active = active;
}

void Automaton::set_source(std::size_t source, bool open) {
  impl_->world.state.sources.at(source).open = open;
}

void Automaton::mark_origins() {
  State& state = impl_->world.state;
  std::transform(state.particles.begin(), state.particles.end(), state.origins.begin(),
                 [](const Particle& particle) { return particle.site(); });
}

}  // namespace clca::automaton
