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
      for (std::size_t id = before; id < state.particles.size(); ++id) {
        removed += discharge(static_cast<std::uint32_t>(id)) ? 1U : 0U;
      }
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
    const Owner code = wall_code(number);
    std::vector<std::size_t> vacated;
    for (const lattice::Site site : wall.sites) {
      const std::size_t index = state.lattice.index(site);
      if (occupancy.owner(index) == code) {
        occupancy.release(index);
        vacated.push_back(index);
      }
    }
    leave_to_others(vacated);
    for (const std::size_t index : vacated) {
      wake_upstream(state.lattice.site(index));
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
    if (!particle.present) {
      return false;
    }
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

  /// Gives the sites of a wall that went to the walls that cover them too.
  void leave_to_others(std::vector<std::size_t>& vacated) {
    std::sort(vacated.begin(), vacated.end());
    for (std::size_t other = 0; other < state.walls.size(); ++other) {
      if (!state.walls[other].present) {
        continue;
      }
      for (const lattice::Site site : state.walls[other].sites) {
        const std::size_t index = state.lattice.index(site);
        if (std::binary_search(vacated.begin(), vacated.end(), index)) {
          occupancy.take(index, wall_code(other));
        }
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
