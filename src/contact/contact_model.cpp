#include "clca/contact/contact_model.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "clca/random/draw.hpp"
#include "clca/reflection/hash.hpp"
#include "contact/energy_of.hpp"
#include "contact/engine/engine.hpp"
#include "contact/rule/acceleration.hpp"
#include "contact/rule/step.hpp"
#include "contact/rule/walls.hpp"
#include "grains/internal/filling.hpp"
#include "grains/internal/outlet.hpp"
#include "grains/internal/source.hpp"
#include "grains/internal/wall.hpp"
#include "grains/internal/wall_step.hpp"

namespace clca::contact {

namespace {

Rule make_rule(const State& state, const Parameters& parameters, double gravity,
               const Options& options) {
  const auto friction = [](double value) { return to_fixed_point(value, kRatioBits); };
  Rule rule = {.gravity = to_fixed_point(gravity, kFractionBits),
               .restitution = to_fixed_point(parameters.restitution, kRatioBits),
               .sweeps = parameters.sweeps,
               .friction = friction(parameters.friction),
               .side_friction = friction(parameters.wall_friction),
               .wall_friction = std::vector<std::int32_t>(state.grains.walls.size(),
                                                          friction(parameters.wall_friction)),
               .law = {.turns = parameters.rolling != Rolling::none,
                       .resists_rolling = parameters.rolling == Rolling::resistance,
                       .rolling_friction = friction(parameters.rolling_friction)},
               .bodies = Bodies(state.grains.kinds, parameters.rolling)};
  for (std::size_t wall = 0; wall < options.wall_friction.size(); ++wall) {
    if (options.wall_friction[wall]) {
      rule.wall_friction[wall] = friction(*options.wall_friction[wall]);
    }
  }
  return rule;
}

State valid(State state, const Parameters& parameters, const Options& options) {
  if (state.grains.step == 0 && state.wall_remainders.empty()) {
    state.wall_remainders.resize(state.grains.walls.size());
  }
  check_valid(state);
  const bool walls_sane =
      std::all_of(options.wall_friction.begin(), options.wall_friction.end(),
                  [](std::optional<double> friction) { return !friction || *friction >= 0; });
  const bool sane = walls_sane && parameters.friction >= 0 && parameters.wall_friction >= 0 &&
                    parameters.rolling_friction >= 0 && parameters.restitution >= 0 &&
                    parameters.restitution < 1 && parameters.sweeps > 0;
  if (!sane) {
    throw std::invalid_argument("a parameter of the contact model is out of range");
  }
  if (options.wall_friction.size() > state.grains.walls.size()) {
    throw std::invalid_argument("there are more frictions than walls");
  }
  if (parameters.rolling != Rolling::none) {
    for (const grains::Kind& kind : state.grains.kinds) {
      if (!kind.shape.is_hexagon()) {
        throw std::invalid_argument("only hexagons turn: others need Rolling::none");
      }
    }
  }
  return state;
}

double gravity_in(const lattice::Lattice& box, Parameters parameters) {
  if (parameters.fall_height == 0) {
    parameters.fall_height = default_fall_height(box.size().y());
  }
  return gravity(parameters);
}

}  // namespace

double default_fall_height(double box_height) {
  return std::max(kMinFallHeight, box_height);
}

double gravity(const Parameters& parameters) {
  const double value = parameters.resolution * parameters.resolution / (2 * parameters.fall_height);
  if (!(parameters.fall_height > 0 && value <= kMaxGravity && value >= kMinGravity)) {
    throw std::invalid_argument("resolution and fall height do not give a time step");
  }
  return to_fixed_point(value, kFractionBits) / static_cast<double>(kSpacing);  // as steps have it
}

std::uint64_t hash(const State& state) {
  return reflection::hash(state);
}

void check_valid(const State& state) {
  grains::check_valid(state.grains);
  check_valid(state.vessel);
  const auto fail = [](const char* reason) { throw std::invalid_argument(reason); };
  if (grains::may_overlap(state.grains)) {
    fail("the contact model lets no walls overlap");
  }
  if (state.wall_remainders.size() != state.grains.walls.size()) {
    fail("there is not one remainder for each wall");
  }
  for (std::size_t wall = 0; wall < state.wall_remainders.size(); ++wall) {
    const grains::Wall& one = state.grains.walls[wall];
    const std::int64_t ahead = state.wall_remainders[wall];
    if (one.motion ? !grains::can_be_ahead(*one.motion, one.travel, ahead) : ahead != 0) {
      fail("a wall is not where its motion has brought it");
    }
  }
  const std::size_t grains = state.grains.particles.size();
  if (state.velocities.size() != grains || state.remainders.size() != grains) {
    fail("there is not one velocity for each grain");
  }
  const auto in_range = [](std::int32_t value, std::int32_t most) {
    return value >= -most && value <= most;
  };
  for (const Velocity<std::int32_t>& velocity : state.velocities) {
    if (!in_range(velocity.x, kMaxVelocity) || !in_range(velocity.y, kMaxVelocity) ||
        !in_range(velocity.spin, kMaxVelocity)) {
      fail("a velocity is out of range");
    }
  }
  for (const Vector& remainder : state.remainders) {
    if (!in_range(remainder.x, kMaxRemainder) || !in_range(remainder.y, kMaxRemainder)) {
      fail("a remainder is out of range");
    }
  }
  std::vector<std::pair<std::uint32_t, grains::Owner>> pairs;
  for (const Contact& contact : state.contacts) {
    const bool with_grain = grains::is_particle(contact.other);
    const bool there = contact.upper < grains &&
                       (with_grain ? static_cast<std::size_t>(contact.other) < grains &&
                                         contact.upper != static_cast<std::uint32_t>(contact.other)
                                   : is_side(contact.other) || (grains::is_wall(contact.other) &&
                                                                grains::wall_number(contact.other) <
                                                                    state.grains.walls.size()));
    if (!there) {
      fail("a contact is not one of two bodies");
    }
    if (!in_range(contact.normal.x, 1 << kUnitBits) ||
        !in_range(contact.normal.y, 1 << kUnitBits)) {
      fail("a normal is out of range");
    }
    if (contact.impulse.normal < 0 || !in_range(contact.impulse.normal, kMaxImpulse) ||
        !in_range(contact.impulse.shear, kMaxImpulse) ||
        !in_range(contact.impulse.rolling, kMaxImpulse)) {
      fail("an impulse is out of range");
    }
    const auto upper = static_cast<grains::Owner>(contact.upper);
    pairs.emplace_back(
        static_cast<std::uint32_t>(with_grain ? std::min(upper, contact.other) : upper),
        with_grain ? std::max(upper, contact.other) : contact.other);
  }
  std::sort(pairs.begin(), pairs.end());
  if (std::adjacent_find(pairs.begin(), pairs.end()) != pairs.end()) {
    fail("two bodies have two contacts");
  }
}

class ContactModel::Impl {
 public:
  Impl(State initial, const Parameters& parameters, const Options& options)
      : state_(valid(std::move(initial), parameters, options)),
        occupancy_(state_.grains),
        footprints_(state_.grains, {}),
        edges_(state_.grains),
        gravity_(gravity_in(state_.grains.lattice, parameters)),
        rule_(make_rule(state_, parameters, gravity_, options)),
        normals_(state_.grains.kinds) {
    if (!options.reference) {
      engine_.emplace(
          state_, occupancy_, footprints_, edges_, rule_,
          parallel::Threads{.count = options.threads, .min_per_thread = options.split_from},
          options.profile);
    }
  }

  const State& state() {
    if (engine_ && !written_back_) {
      engine_->write_back();
      written_back_ = true;
    }
    return state_;
  }
  const grains::State& grains() const { return state_.grains; }
  const grains::OccupancyTable& occupancy() const { return occupancy_; }
  const Vessel& vessel() const { return state_.vessel; }
  double gravity() const { return gravity_; }

  template <class Change>
  auto whole(Change change) {
    if (half_changed_) {
      throw std::logic_error("a contact model cannot go on after a change that failed");
    }
    half_changed_ = true;
    auto result = change();
    half_changed_ = false;
    return result;
  }

  StepReport step() {
    return whole([this] {
      StepReport report;
      const std::size_t before = state_.grains.particles.size();
      const grains::SourceReport sources = run_sources(state_.grains, occupancy_);
      report.emitted = state_.grains.particles.size() - before;
      add_motions();
      scatter(before);
      exchange_ = {};
      for (std::size_t id = before; id < state_.grains.particles.size(); ++id) {
        exchange_.sources += energy_of(state_, id, gravity_).sum();
      }
      if (engine_) {
        engine_->add_grains();
      }
      std::vector<std::uint32_t> moved = move_and_work();
      for (std::size_t id = before; id < state_.grains.particles.size(); ++id) {
        moved.push_back(static_cast<std::uint32_t>(id));
      }
      report.removed = remove_at_outlets(moved);
      if (report.emitted > 0) {
        state_.quiet_steps = 0;  // what is new still has to fall
      }
      report.settled = state_.quiet_steps >= kQuietSteps && report.emitted == 0 &&
                       !sources.waiting && walls_rest(state_);
      report.quiet = state_.quiet_steps > 0;
      report.moved = moved_;
      report.exchange = exchange_;
      return report;
    });
  }

  /// Applies a change of grains or walls from outside.
  template <class Change>
  auto change(Change change) {
    return whole([&] {
      state();
      auto result = change(state_.grains, occupancy_);
      add_motions();
      if (engine_) {
        engine_->reload();
      }
      std::vector<std::uint32_t> all(state_.grains.particles.size());
      std::iota(all.begin(), all.end(), 0U);
      remove_at_outlets(all);
      state_.changed = true;
      state_.quiet_steps = 0;
      return result;
    });
  }

  void set_motion(std::size_t wall, bool active) {
    grains::Wall& moving = state_.grains.walls.at(wall);
    if (!moving.motion) {
      throw std::invalid_argument("a wall without motion cannot be set in motion");
    }
    moving.travel.active = active;
    state_.quiet_steps = 0;
  }
  void set_source(std::size_t source, bool open) { state_.grains.sources.at(source).open = open; }
  void set_vessel(const Vessel& vessel) {
    check_valid(vessel);
    state_.changed = state_.changed || down(vessel) != down(state_.vessel);
    state_.vessel = vessel;
    state_.quiet_steps = 0;
  }
  void mark_origins() {
    grains::State& grains = state_.grains;
    std::transform(grains.particles.begin(), grains.particles.end(), grains.origins.begin(),
                   [](const grains::Particle& particle) { return particle.site(); });
  }

 private:
  /// Grains from a source start anywhere within a spacing; otherwise those of one site would stack
  /// vertically.
  void scatter(std::size_t first) {
    for (std::size_t id = first; id < state_.remainders.size(); ++id) {
      const std::uint64_t bits =
          random::draw(state_.grains.seed, state_.grains.step, static_cast<std::uint32_t>(id),
                       random::Purpose::source_remainder);
      state_.remainders[id].x =
          static_cast<std::int32_t>(random::below(bits, kSpacing)) - kSpacing / 2;
    }
  }

  /// For new grains, which are at rest.
  void add_motions() {
    state_.velocities.resize(state_.grains.particles.size());
    state_.remainders.resize(state_.grains.particles.size());
  }

  /// Grains that moved, without duplicates.
  std::vector<std::uint32_t> move() {
    std::vector<std::uint32_t> moved;
    if (engine_) {
      engine_->step();
      moved.assign(engine_->moved().begin(), engine_->moved().end());
    } else {
      moved = reference_step(state_, occupancy_, footprints_, edges_, rule_, normals_);
    }
    moved_ = moved.size();
    written_back_ = false;
    return moved;
  }

  /// The same; adds the work of walls and vessel to the exchange.
  std::vector<std::uint32_t> move_and_work() {
    const std::vector<double> walls = wall_positions(state_);
    const Vessel vessel = state_.vessel;
    std::vector<std::uint32_t> moved = move();
    if (wall_positions(state_) != walls) {
      exchange_.walls =
          wall_work(state_, engine_ ? engine_->wall_contacts() : state_.contacts, walls, gravity_);
    }
    if (vessel.moves()) {
      if (engine_) {
        engine_->write_back_velocities();
      }
      exchange_.vessel = vessel_work(state_, vessel, gravity_);
    }
    return moved;
  }

  std::size_t remove_at_outlets(const std::vector<std::uint32_t>& ids) {
    if (state_.grains.outlets.empty()) {
      return 0;
    }
    std::size_t removed = 0;
    for (const std::uint32_t id : ids) {
      if (count_at_outlet(state_.grains, id)) {
        take_away(id);
        ++removed;
      }
    }
    return removed;
  }

  void take_away(std::uint32_t id) {
    grains::Particle& grain = state_.grains.particles[id];
    const std::size_t place = state_.grains.lattice.index(grain.site());
    const int column = state_.grains.lattice.wrapped(grain.column);
    for (const lattice::Offset offset : footprints_.of(grain).body) {
      occupancy_.release(state_.grains.lattice.at(place, column, offset));
    }
    if (engine_) {
      state_.velocities[id] = engine_->velocity_of(id);
    }
    exchange_.outlets += energy_of(state_, id, gravity_).sum();
    grain.present = false;
    grain.previous = grains::kRest;
    state_.velocities[id] = {};
    state_.remainders[id] = {};
    if (engine_) {
      engine_->remove_grain(id);
    }
  }

  State state_;
  grains::OccupancyTable occupancy_;
  grains::FootprintTable footprints_;
  grains::WallEdges edges_;
  double gravity_;  // lattice spacings per step squared
  Rule rule_;
  NormalTable normals_;  // of the reference
  std::optional<Engine> engine_;
  std::size_t moved_ = 0;
  EnergyExchange exchange_;   // in this step
  bool written_back_ = true;  // of the engine, to the state
  bool half_changed_ = false;
};

ContactModel::ContactModel(State state, const Parameters& parameters, const Options& options)
    : impl_(std::make_unique<Impl>(std::move(state), parameters, options)) {}
ContactModel::~ContactModel() = default;
ContactModel::ContactModel(ContactModel&&) noexcept = default;
ContactModel& ContactModel::operator=(ContactModel&&) noexcept = default;

const State& ContactModel::state() const {
  return impl_->state();
}
const grains::State& ContactModel::grains() const {
  return impl_->grains();
}
grains::Occupancy ContactModel::occupancy() const {
  return impl_->occupancy();
}
const Vessel& ContactModel::vessel() const {
  return impl_->vessel();
}
double ContactModel::gravity() const {
  return impl_->gravity();
}
StepReport ContactModel::step() {
  return impl_->step();
}

grains::FillResult ContactModel::fill(const lattice::Rectangle& region,
                                      std::span<const std::size_t> counts) {
  grains::check_counts(grains(), counts);
  lattice::check(region);
  return impl_->change([&](grains::State& state, grains::OccupancyTable& occupancy) {
    return grains::fill_region(state, occupancy, region, counts);
  });
}

grains::FillResult ContactModel::deposit(const lattice::Rectangle& region,
                                         std::span<const std::size_t> counts) {
  grains::check_counts(grains(), counts);
  lattice::check(region);
  return impl_->change([&](grains::State& state, grains::OccupancyTable& occupancy) {
    return grains::deposit_in(state, occupancy, region, counts);
  });
}

grains::FillResult ContactModel::fill(const lattice::Rectangle& region,
                                      const grains::Mixture& mixture) {
  lattice::check(region);
  return impl_->change([&](grains::State& state, grains::OccupancyTable& occupancy) {
    return grains::fill_with(state, occupancy, region, mixture);
  });
}

void ContactModel::remove_wall(std::size_t wall) {
  static_cast<void>(grains().walls.at(wall));
  impl_->change([&](grains::State& state, grains::OccupancyTable& occupancy) {
    return grains::remove_wall(state, occupancy, wall);
  });
}

bool ContactModel::insert_wall(std::size_t wall) {
  static_cast<void>(grains().walls.at(wall));
  return impl_->change([&](grains::State& state, grains::OccupancyTable& occupancy) {
    return grains::insert_wall(state, occupancy, wall);
  });
}

void ContactModel::set_motion(std::size_t wall, bool active) {
  impl_->set_motion(wall, active);
}

void ContactModel::set_source(std::size_t source, bool open) {
  impl_->set_source(source, open);
}

void ContactModel::set_vessel(const Vessel& vessel) {
  impl_->set_vessel(vessel);
}

void ContactModel::mark_origins() {
  impl_->mark_origins();
}

}  // namespace clca::contact
