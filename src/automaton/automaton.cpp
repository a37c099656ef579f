#include "clca/automaton/automaton.hpp"

#include <algorithm>
#include <utility>

#include "automaton/fill.hpp"
#include "automaton/source.hpp"
#include "automaton/stepper.hpp"

namespace clca::automaton {

class Automaton::Impl {
 public:
  Impl(State initial, Options options)
      : state(std::move(initial)), occupancy(state), stepper(state, options) {
    state.origins.resize(state.particles.size());
    welcome_from(0);
  }

  StepReport step() {
    StepReport report;
    const std::size_t before = state.particles.size();
    const SourceReport sources = run_sources(state, occupancy);
    report.emitted = state.particles.size() - before;
    welcome_from(before);
    report.moved = stepper.advance(state, occupancy);
    if (!state.outlets.empty()) {
      std::size_t& removed = report.removed;
      stepper.for_each_moved(state, [&](std::uint32_t id) { removed += discharge(id) ? 1U : 0U; });
    }
    report.settled = report.moved == 0 && report.emitted == 0 && !sources.waiting;
    ++state.step;
    return report;
  }

  FillResult fill(const lattice::Rectangle& region, std::span<const std::size_t> counts) {
    const std::size_t before = state.particles.size();
    FillResult result = fill_region(state, occupancy, region, counts);
    welcome_from(before);
    for (std::size_t id = before; id < state.particles.size(); ++id) {
      discharge(static_cast<std::uint32_t>(id));
    }
    return result;
  }

  void remove_wall(std::size_t number) {
    Wall& wall = state.walls.at(number);
    wall.present = false;
    const Owner code = kFirstWall - static_cast<Owner>(number);
    std::vector<lattice::Site> vacated;
    for (const lattice::Site site : wall.sites) {
      if (occupancy.owner(state.lattice.index(site)) == code) {
        release_to_others(site);
        vacated.push_back(site);
      }
    }
    for (const lattice::Site site : vacated) {
      wake_upstream(site);
    }
  }

  State state;
  Occupancy occupancy;
  Stepper stepper;

 private:
  /// Makes room for particles that are new from id `first` on and wakes them.
  void welcome_from(std::size_t first) {
    stepper.grow(state.particles.size());
    for (std::size_t id = first; id < state.particles.size(); ++id) {
      stepper.wake(static_cast<std::uint32_t>(id));
    }
  }

  /// Removes the particle if it lies wholly inside an outlet.
  bool discharge(std::uint32_t id) {
    Particle& particle = state.particles[id];
    const auto outlet =
        std::find_if(state.outlets.begin(), state.outlets.end(),
                     [&](const Outlet& o) { return lies_inside(state, particle, o.region); });
    if (outlet == state.outlets.end()) {
      return false;
    }
    stepper.wake_around(state, occupancy, particle);
    const lattice::Shape& shape = state.shape(particle);
    for (const lattice::Axial part : shape.sites()) {
      occupancy.release(state.lattice.index(particle.site() + part));
    }
    particle.present = false;
    particle.previous = kRest;
    ++outlet->particles;
    outlet->sites += shape.size();
    return true;
  }

  /// Frees a wall site, or leaves it to another wall that covers it too.
  void release_to_others(lattice::Site site) {
    const std::size_t index = state.lattice.index(site);
    occupancy.release(index);
    for (std::size_t other = 0; other < state.walls.size(); ++other) {
      const Wall& wall = state.walls[other];
      if (wall.present &&
          std::find(wall.sites.begin(), wall.sites.end(), site) != wall.sites.end()) {
        occupancy.take(index, kFirstWall - static_cast<Owner>(other));
      }
    }
  }

  void wake_upstream(lattice::Site site) {
    for (const lattice::Direction direction : candidate_directions(state.rules)) {
      const lattice::Site from = site + lattice::unit(opposite(direction));
      if (!state.lattice.contains(from)) {
        continue;
      }
      const Owner owner = occupancy.owner(state.lattice.index(from));
      if (is_particle(owner)) {
        stepper.wake(static_cast<std::uint32_t>(owner));
      }
    }
  }
};

Automaton::Automaton(State state, Options options)
    : impl_(std::make_unique<Impl>(std::move(state), options)) {}
Automaton::~Automaton() = default;
Automaton::Automaton(Automaton&&) noexcept = default;
Automaton& Automaton::operator=(Automaton&&) noexcept = default;

const State& Automaton::state() const {
  return impl_->state;
}
const Occupancy& Automaton::occupancy() const {
  return impl_->occupancy;
}
StepReport Automaton::step() {
  return impl_->step();
}

FillResult Automaton::fill(const lattice::Rectangle& region, std::span<const std::size_t> counts) {
  return impl_->fill(region, counts);
}

void Automaton::remove_wall(std::size_t wall) {
  impl_->remove_wall(wall);
}

void Automaton::set_source(std::size_t source, bool open) {
  impl_->state.sources.at(source).open = open;
}

void Automaton::mark_origins() {
  State& state = impl_->state;
  std::transform(state.particles.begin(), state.particles.end(), state.origins.begin(),
                 [](const Particle& particle) { return particle.site(); });
}

}  // namespace clca::automaton
