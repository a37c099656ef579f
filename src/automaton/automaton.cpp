#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "automaton/engine/engine.hpp"
#include "automaton/rule/moving_walls.hpp"
#include "automaton/rule/step.hpp"
#include "grains/internal/filling.hpp"

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
  Impl(grains::State initial, const Rules& rules, const Options& options)
      : world(valid(std::move(initial), rules, options), rules), walls_(world.state) {
    if (!options.reference) {
      particles_.emplace<Engine>(world, options);
    }
  }

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
    return std::visit([&](auto& particles) { return one_step(world, walls_, particles); },
                      particles_);
  }

  /// `place` puts the particles into a region: fill_region, deposit_in or fill_with.
  template <class Place, class Contents>
  grains::FillResult fill(Place place, const lattice::Rectangle& region, const Contents& contents) {
    const std::size_t before = world.state.particles.size();
    grains::FillResult result = place(world.state, world.occupancy, region, contents);
    world.include_new(before);
    for (std::size_t id = before; id < world.state.particles.size(); ++id) {
      remove_at_outlet(world, static_cast<std::uint32_t>(id));
    }
    return result;
  }

  World world;

 private:
  MovingWalls walls_;
  std::variant<ReferenceStep, Engine> particles_{std::in_place_type<ReferenceStep>, world};
  bool half_changed_ = false;
};

namespace {

void check_deposition(const Rules& rules) {
  if (rules.gravity != lattice::Direction::down) {
    throw std::invalid_argument("particles are deposited along a gravity that points down");
  }
}

}  // namespace

double step_bytes(double places) {
  return SiteReservations::bytes_for(places);
}

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
grains::Occupancy Automaton::occupancy() const {
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
  check_deposition(rules());
  return impl_->whole([&] { return impl_->fill(grains::deposit_in, region, counts); });
}

grains::FillResult Automaton::fill(const lattice::Rectangle& region,
                                   const grains::Mixture& mixture) {
  lattice::check(region);
  if (mixture.deposited) {
    check_deposition(rules());
  }
  return impl_->whole([&] { return impl_->fill(grains::fill_with, region, mixture); });
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
