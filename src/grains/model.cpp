#include "clca/grains/model.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "grains/internal/filling.hpp"
#include "grains/internal/mechanics.hpp"
#include "lattice/internal/require.hpp"

namespace clca::grains {

namespace {

/// Removes those of these particles that lie wholly in an outlet, in the order of their ids: what
/// is summed over them is the same for each order of `ids`. Returns how many.
std::size_t remove_at_outlets(Mechanics& mechanics, std::vector<std::uint32_t> ids) {
  Box& box = mechanics.box();
  std::erase_if(ids, [&](std::uint32_t id) {
    return outlet_around(box.state, box.state.particles[id]) == box.state.outlets.size();
  });
  std::ranges::sort(ids);
  std::size_t removed = 0;
  for (const std::uint32_t id : ids) {
    if (count_at_outlet(box.state, id)) {
      mechanics.removing(id);
      take_out(box, id);
      ++removed;
    }
  }
  return removed;
}

/// The ids from `first` on.
std::vector<std::uint32_t> ids_from(std::size_t first, const State& state) {
  std::vector<std::uint32_t> ids(state.particles.size() - first);
  std::iota(ids.begin(), ids.end(), static_cast<std::uint32_t>(first));
  return ids;
}

}  // namespace

void check_valid(const Options& options) {
  require(options.threads >= 1, "the number of threads must be positive");
}

void take_out(Box& box, std::uint32_t id) {
  Particle& particle = box.state.particles[id];
  box.for_each_index(particle,
                     [&](std::size_t index) { box.occupancy.remove(index, as_owner(id)); });
  particle.present = false;
  particle.previous = kRest;
}

StepReport step(Mechanics& mechanics) {
  StepReport report;
  const State& state = mechanics.box().state;
  mechanics.before_sources();

  const std::size_t before = state.particles.size();
  const bool sources_wait = run_sources(mechanics.box());
  report.emitted = state.particles.size() - before;
  mechanics.added(before);

  const bool at_rest = mechanics.advance(report);

  if (!state.outlets.empty()) {
    report.removed = remove_at_outlets(mechanics, mechanics.moved());
    report.removed += remove_at_outlets(mechanics, ids_from(before, state));
  }
  report.settled = at_rest && report.emitted == 0 && !sources_wait;
  return report;
}

Model::Model(std::unique_ptr<Mechanics> mechanics) : mechanics_(std::move(mechanics)) {}
Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

void Model::check_whole() const {
  if (half_changed_) {
    throw std::logic_error("a model cannot go on after a change that failed");
  }
}

/// Carries out a change; nothing more is changed after one that has failed halfway.
template <class Change>
auto Model::whole(Change change) {
  check_whole();
  half_changed_ = true;
  auto result = change();
  half_changed_ = false;
  return result;
}

/// Carries out a change of particles or walls in between steps.
template <class Change>
auto Model::changed(Change change) {
  return whole([&] {
    auto result = change(mechanics_->box());
    mechanics_->reloaded();
    remove_at_outlets(*mechanics_, ids_from(0, grains()));
    return result;
  });
}

const State& Model::grains() const {
  return mechanics_->box().state;
}
Occupancy Model::occupancy() const {
  return mechanics_->box().occupancy;
}
lattice::Direction Model::down() const {
  return mechanics_->down();
}
StepReport Model::step() {
  return whole([&] { return grains::step(*mechanics_); });
}

void Model::set_interruption(std::function<void()> check) {
  mechanics_->box().interruption = std::move(check);
}

FillResult Model::fill(const lattice::Rectangle& region, std::span<const std::size_t> counts) {
  check_counts(grains(), counts);
  lattice::check(region);
  return changed([&](Box& box) { return fill_region(box, region, counts); });
}

FillResult Model::deposit(const lattice::Rectangle& region, std::span<const std::size_t> counts) {
  check_counts(grains(), counts);
  lattice::check(region);
  check_deposits();
  return changed([&](Box& box) { return deposit_in(box, region, counts); });
}

FillResult Model::fill(const lattice::Rectangle& region, const Mixture& mixture) {
  check_mixture(grains(), mixture);
  lattice::check(region);
  if (mixture.deposited) {
    check_deposits();
  }
  return changed([&](Box& box) { return fill_with(box, region, mixture); });
}

void Model::check_deposits() const {
  require(mechanics_->deposits(), "particles are deposited along a gravity that points down");
}

void Model::remove_wall(std::size_t wall) {
  check_whole();
  if (grains().walls.at(wall).present) {
    changed([&](Box& box) {
      grains::remove_wall(box, wall);
      return true;
    });
  }
}

bool Model::insert_wall(std::size_t wall) {
  check_whole();
  if (grains().walls.at(wall).present) {
    return true;
  }
  if (!can_insert_wall(mechanics_->box(), wall)) {
    return false;
  }
  return changed([&](Box& box) {
    grains::insert_wall(box, wall);
    return true;
  });
}

void Model::set_motion(std::size_t wall, bool active) {
  Wall& moving = mechanics_->box().state.walls.at(wall);
  require(moving.motion.has_value(), "a wall without motion cannot be set in motion");
  whole([&] {
    moving.travel.active = active;
    mechanics_->motion_set();
    return true;
  });
}

void Model::set_source(std::size_t source, bool open) {
  check_whole();
  mechanics_->box().state.sources.at(source).open = open;
}

void Model::mark_origins() {
  check_whole();
  State& state = mechanics_->box().state;
  std::ranges::transform(state.particles, state.origins.begin(),
                         [](const Particle& particle) { return particle.site(); });
}

}  // namespace clca::grains
