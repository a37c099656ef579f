#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "automaton/stepper.hpp"
#include "automaton/wall_mover.hpp"
#include "automaton/wall_presence.hpp"
#include "clca/grains/deposit.hpp"
#include "clca/grains/outlet.hpp"
#include "clca/grains/source.hpp"

namespace clca::automaton {

namespace {

grains::State valid(grains::State state, const Rules& rules, const Options& options) {
  if (options.threads < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
  check_rules(rules);
  check_valid(state);
  return state;
}

}  // namespace

class Automaton::Impl {
 public:
  Impl(grains::State initial, const Rules& rules, Options options)
      : world(valid(std::move(initial), rules, options), rules),
        stepper(world, options),
        walls(world.state) {}

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
    grains::State& state = world.state;
    walls.advance(world, report);
    const std::size_t before = state.particles.size();
    const grains::SourceReport sources = run_sources(state, world.occupancy);
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
  grains::FillResult fill(Place place, const lattice::Rectangle& region,
                          std::span<const std::size_t> counts) {
    const std::size_t before = world.state.particles.size();
    grains::FillResult result = place(world.state, world.occupancy, region, counts);
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
    if (!count_at_outlet(world.state, id)) {
      return false;
    }
    world.take_away(id);
    return true;
  }
};

Automaton::Automaton(grains::State state, Rules rules, Options options)
    : impl_(std::make_unique<Impl>(std::move(state), rules, options)) {}
Automaton::~Automaton() = default;
Automaton::Automaton(Automaton&&) noexcept = default;
Automaton& Automaton::operator=(Automaton&&) noexcept = default;

const grains::State& Automaton::state() const {
  return impl_->world.state;
}
const Rules& Automaton::rules() const {
  return impl_->world.rules;
}
const grains::Occupancy& Automaton::occupancy() const {
  return impl_->world.occupancy;
}
StepReport Automaton::step() {
  return impl_->whole([&] { return impl_->step(); });
}

grains::FillResult Automaton::fill(const lattice::Rectangle& region,
                                   std::span<const std::size_t> counts) {
  check_counts(state(), counts);
  lattice::check(region);
  return impl_->whole([&] { return impl_->fill(grains::fill_region, region, counts); });
}

grains::FillResult Automaton::deposit(const lattice::Rectangle& region,
                                      std::span<const std::size_t> counts) {
  check_counts(state(), counts);
  lattice::check(region);
  if (rules().gravity != lattice::Direction::down) {
    throw std::invalid_argument("particles are deposited along a gravity that points down");
  }
  return impl_->whole([&] { return impl_->fill(grains::deposit_in, region, counts); });
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
  grains::Wall& moving = impl_->world.state.walls.at(wall);
  if (!moving.motion) {
    throw std::invalid_argument("a wall without motion cannot be set in motion");
  }
  moving.travel.active = active;
}

void Automaton::set_source(std::size_t source, bool open) {
  impl_->world.state.sources.at(source).open = open;
}

void Automaton::mark_origins() {
  grains::State& state = impl_->world.state;
  std::transform(state.particles.begin(), state.particles.end(), state.origins.begin(),
                 [](const grains::Particle& particle) { return particle.site(); });
}

}  // namespace clca::automaton
