#include "clca/grains/model.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "grains/internal/filling.hpp"
#include "grains/internal/mechanics.hpp"
#include "lattice/internal/require.hpp"

namespace clca::grains {

namespace {

/// Tries every site of the source once, starting at a random one.
bool emit_one(Box& box, Source& source, std::uint32_t number) {
  const State& state = box.state;
  // Keyed by the number emitted so far: a waiting particle keeps its draw.
  const std::size_t kind = weighted_index(
      source.weights,
      random::draw(state.seed, source.emitted, number, random::Purpose::source_species));
  const std::uint64_t bits = random::draw(state.seed, state.step + source.emitted, number,
                                          random::Purpose::source_position);
  const std::size_t start = random::uniform_below(bits, source.sites.size());
  for (std::size_t i = 0; i < source.sites.size(); ++i) {
    const lattice::Site site = source.sites[(start + i) % source.sites.size()];
    const Particle particle = {
        .column = site.column, .row = site.row, .kind = static_cast<std::uint16_t>(kind)};
    if (fits(box, particle)) {
      insert(box, particle);
      ++source.emitted;
      return true;
    }
  }
  return false;
}

/// False if the source is exhausted or the particle does not fit.
bool run_source(Box& box, Source& source, std::uint32_t number) {
  source.credit = std::min(source.credit, source.units_per_particle) + source.rate;
  while (source.credit >= source.units_per_particle && !source.is_exhausted()) {
    if (!emit_one(box, source, number)) {
      return false;
    }
    source.credit -= source.units_per_particle;
  }
  return !source.is_exhausted();
}

/// Emits the particles that are due from every open source, if they fit. Those that do not fit stay
/// due, up to one step's share. Returns whether a source will emit if nothing changes.
bool run_sources(Box& box) {
  bool waits = false;
  for (std::size_t number = 0; number < box.state.sources.size(); ++number) {
    Source& source = box.state.sources[number];
    if (source.open && !source.is_exhausted()) {
      waits = run_source(box, source, static_cast<std::uint32_t>(number)) || waits;
    }
  }
  return waits;
}

std::vector<std::size_t> indices_now(const State& state, const Wall& wall) {
  std::vector<std::size_t> result;
  for (const lattice::Site site : current_sites(state.lattice, wall)) {
    result.push_back(state.lattice.index(site));
  }
  return result;
}

/// Removes a wall. Its sites go to other walls that cover them.
void remove_wall(Box& box, std::size_t number) {
  Wall& wall = box.state.walls[number];
  const Owner code = wall_code(number);
  wall.present = false;
  std::vector<std::size_t> vacated;
  for (const std::size_t index : indices_now(box.state, wall)) {
    if (box.occupancy.has_owner(index, code) && box.occupancy.remove_owner(index, code)) {
      vacated.push_back(index);
    }
  }
  std::ranges::sort(vacated);
  for (std::size_t other = 0; other < box.state.walls.size(); ++other) {
    if (!box.state.walls[other].present) {
      continue;
    }
    for (const std::size_t index : indices_now(box.state, box.state.walls[other])) {
      if (std::ranges::binary_search(vacated, index)) {
        box.occupancy.take(index, wall_code(other));
      }
    }
  }
}

/// Whether no particle is in the way of a new wall, nor another wall while one of the two moves.
bool can_insert_wall(const Box& box, std::size_t number) {
  const Wall& wall = box.state.walls[number];
  const std::vector<std::size_t> indices = indices_now(box.state, wall);
  const auto moves = [&](Owner owner) {
    return is_obstacle(owner) && box.state.walls[wall_number(owner)].motion.has_value();
  };
  return std::ranges::none_of(indices, [&](std::size_t index) {
    const Owner owner = box.occupancy.owner(index);
    return is_particle(owner) || moves(owner) || (owner != kFree && wall.motion.has_value());
  });
}

/// Inserts a wall that is not there and can be inserted.
void insert_wall(Box& box, std::size_t number) {
  Wall& wall = box.state.walls[number];
  wall.present = true;
  for (const std::size_t index : indices_now(box.state, wall)) {
    const Owner owner = box.occupancy.owner(index);
    if (!is_obstacle(owner) || wall_number(owner) < number) {  // as in an OccupancyTable built anew
      box.occupancy.take(index, wall_code(number));
    }
  }
}

/// Removes those of these particles that lie wholly in an outlet, in the order of their ids: what
/// is summed over them is the same for each order of `ids`. Returns how many.
std::size_t remove_at_outlets(Mechanics& mechanics, std::vector<std::uint32_t> ids) {
  Box& box = mechanics.box();
  std::erase_if(ids, [&](std::uint32_t id) {
    return enclosing_outlet(box.state, box.state.particles[id]) == box.state.outlets.size();
  });
  std::ranges::sort(ids);
  std::size_t removed = 0;
  for (const std::uint32_t id : ids) {
    if (count_at_outlet(box.state, id)) {
      mechanics.on_removing(id);
      remove_particle(box, id);
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

void remove_particle(Box& box, std::uint32_t id) {
  Particle& particle = box.state.particles[id];
  box.for_each_index(particle,
                     [&](std::size_t index) { box.occupancy.remove_owner(index, as_owner(id)); });
  particle.present = false;
  particle.previous = kRest;
}

StepReport step(Mechanics& mechanics) {
  StepReport report;
  const State& state = mechanics.box().state;
  mechanics.before_sources();

  const std::size_t before = state.particles.size();
  const bool sources_wait = run_sources(mechanics.box());
  report.emitted_count = state.particles.size() - before;
  mechanics.on_added(before);

  const bool at_rest = mechanics.advance(report);

  if (!state.outlets.empty()) {
    report.removed_count = remove_at_outlets(mechanics, mechanics.moved_ids());
    report.removed_count += remove_at_outlets(mechanics, ids_from(before, state));
  }
  report.settled = at_rest && report.emitted_count == 0 && !sources_wait;
  return report;
}

Model::Model(std::unique_ptr<Mechanics> mechanics) : mechanics_(std::move(mechanics)) {}
Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

void Model::check_intact() const {
  if (half_changed_) {
    throw std::logic_error("a model cannot go on after a change that failed");
  }
}

/// Carries out a change; nothing more is changed after one that has failed halfway.
template <class Change>
auto Model::carry_out(Change change) {
  check_intact();
  half_changed_ = true;
  auto result = change();
  half_changed_ = false;
  return result;
}

/// Carries out a change of particles or walls in between steps.
template <class Change>
auto Model::change_between_steps(Change change) {
  return carry_out([&] {
    auto result = change(mechanics_->box());
    mechanics_->on_reloaded();
    remove_at_outlets(*mechanics_, ids_from(0, grains()));
    return result;
  });
}

const State& Model::grains() const {
  return mechanics_->box().state;
}
const Occupancy& Model::occupancy() const {
  return mechanics_->box().occupancy;
}
lattice::Direction Model::down() const {
  return mechanics_->down();
}
StepReport Model::step() {
  return carry_out([&] { return grains::step(*mechanics_); });
}

void Model::set_interruption(std::function<void()> check) {
  mechanics_->box().interruption = std::move(check);
}

void Model::check_fill(const lattice::Rectangle& region, bool deposited) const {
  lattice::check_valid(region);
  require(!deposited || mechanics_->can_deposit(),
          "particles are deposited along a gravity that points down");
}

FillResult Model::fill(const lattice::Rectangle& region, std::span<const std::size_t> counts,
                       bool deposited) {
  check_counts(grains(), counts);
  check_fill(region, deposited);
  return change_between_steps([&](Box& box) {
    return deposited ? deposit_region(box, region, counts) : fill_region(box, region, counts);
  });
}

FillResult Model::fill(const lattice::Rectangle& region, const Mixture& mixture) {
  check_mixture(grains(), mixture);
  check_fill(region, mixture.deposited);
  return change_between_steps([&](Box& box) { return fill_mixture(box, region, mixture); });
}

void Model::remove_wall(std::size_t wall) {
  check_intact();
  if (grains().walls.at(wall).present) {
    change_between_steps([&](Box& box) {
      grains::remove_wall(box, wall);
      return true;
    });
  }
}

bool Model::insert_wall(std::size_t wall) {
  check_intact();
  if (grains().walls.at(wall).present) {
    return true;
  }
  if (!can_insert_wall(mechanics_->box(), wall)) {
    return false;
  }
  return change_between_steps([&](Box& box) {
    grains::insert_wall(box, wall);
    return true;
  });
}

void Model::set_wall_moving(std::size_t wall, bool active) {
  Wall& moving = mechanics_->box().state.walls.at(wall);
  require(moving.motion.has_value(), "a wall without motion cannot be set in motion");
  carry_out([&] {
    moving.travel.active = active;
    mechanics_->on_motion_set();
    return true;
  });
}

void Model::set_source_open(std::size_t source, bool open) {
  check_intact();
  mechanics_->box().state.sources.at(source).open = open;
}

void Model::reset_origins() {
  check_intact();
  State& state = mechanics_->box().state;
  std::ranges::transform(state.particles, state.origins.begin(),
                         [](const Particle& particle) { return particle.site(); });
}

}  // namespace clca::grains
