#include "clca/contact/contact_model.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "clca/reflection/hash.hpp"
#include "contact/engine/engine.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

namespace {

std::unique_ptr<grains::Mechanics> make_steps(State state, const Parameters& parameters,
                                              const Options& options) {
  check_valid(options);
  if (options.use_reference) {
    return std::make_unique<ReferenceMechanics>(std::move(state), parameters);
  }
  return std::make_unique<Engine>(std::move(state), parameters);
}

ContactMechanics& steps(grains::Mechanics& mechanics) {
  return static_cast<ContactMechanics&>(mechanics);
}

}  // namespace

double gravity(const Parameters& parameters) {
  const double value = parameters.resolution * parameters.resolution / (2 * parameters.fall_height);
  require(parameters.resolution > 0 && parameters.fall_height > 0 && value <= kMaxGravity &&
              value >= kMinGravity,
          "resolution and fall height do not give a time step");
  return to_fixed_point(value, kFractionBits) / static_cast<double>(kSpacing);  // as steps have it
}

std::uint64_t hash(const State& state) {
  return reflection::hash(state);
}

int min_periodic_columns(const std::vector<grains::Kind>& kinds) {
  int first = 0;
  int last = 0;
  for (const grains::Kind& kind : kinds) {
    first = std::min(first, kind.shape.sites().front().x);  // sorted by x
    last = std::max(last, kind.shape.sites().back().x);
  }
  return 2 * (last - first + 1) + 2;
}

void check_valid(const State& state) {
  grains::check_valid(state.grains);
  check_valid(state.vessel);
  const lattice::Lattice& lattice = state.grains.lattice;
  const std::size_t grains = state.grains.particles.size();
  const std::size_t walls = state.grains.walls.size();
  const int needed = min_periodic_columns(state.grains.kinds);
  require(!lattice.periodic() || lattice.columns() >= needed,
          ("two grains may touch on both sides in a periodic box of " +
           std::to_string(lattice.columns()) + " columns: it needs " + std::to_string(needed))
              .c_str());
  require(!grains::walls_may_overlap(state.grains), "the contact model lets no walls overlap");
  require(state.wall_remainders.size() == walls, "there is not one remainder for each wall");
  for (std::size_t number = 0; number < walls; ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    const std::int64_t ahead = state.wall_remainders[number];
    require(wall.motion ? can_be_ahead(*wall.motion, wall.travel, ahead) : ahead == 0,
            "a wall is not where its motion has brought it");
  }
  require(state.velocities.size() == grains && state.remainders.size() == grains &&
              state.from_anchors.size() == grains,
          "there is not one velocity for each grain");
  const auto in_range = [](std::int32_t most, auto... values) {
    return ((values >= -most && values <= most) && ...);
  };
  for (std::size_t id = 0; id < grains; ++id) {
    const Velocity<>& velocity = state.velocities[id];
    const Vector& remainder = state.remainders[id];
    const lattice::Axial& anchor = state.from_anchors[id];
    require(in_range(1, anchor.x, anchor.q) && length_in_steps(anchor) <= 1,
            "a grain is too far from its anchor");
    require(in_range(kMaxVelocity, velocity.x, velocity.y, velocity.spin),
            "a velocity is out of range");
    require(in_range(kMaxRemainder, remainder.x, remainder.y), "a remainder is out of range");
  }
  std::vector<std::pair<grains::Owner, grains::Owner>> pairs;
  for (const Contact& contact : state.contacts) {
    const auto upper = grains::as_owner(contact.upper);
    const bool with_grain = grains::is_particle(contact.other);
    require(
        contact.upper < grains &&
            (with_grain ? grains::particle_id(contact.other) < grains && contact.other != upper
                        : is_side(contact.other) || (grains::is_obstacle(contact.other) &&
                                                     grains::wall_number(contact.other) < walls)),
        "a contact is not one of two bodies");
    require(in_range(1 << kUnitBits, contact.normal.x, contact.normal.y),
            "a normal is out of range");
    const auto is_sound = [&](const Impulse<>& impulse) {
      return in_range(kMaxImpulse, impulse.normal, impulse.shear, impulse.rolling);
    };
    require(is_sound(contact.impulse) && is_sound(contact.transient) &&
                contact.impulse.normal >= 0 &&
                contact.impulse.normal + contact.transient.normal >= 0,
            "an impulse is out of range");
    pairs.push_back(sorted_bodies(contact.upper, contact.other));
  }
  std::ranges::sort(pairs);
  require(std::ranges::adjacent_find(pairs) == pairs.end(), "two bodies have two contacts");
}

double step_bytes(double grains) {
  return grains * Engine::kBytesPerGrain;
}

ContactModel::ContactModel(State state, const Parameters& parameters, const Options& options)
    : Model(make_steps(std::move(state), parameters, options)) {}

const State& ContactModel::state() const {
  steps(mechanics()).write_contacts_back();
  return steps(mechanics()).state();
}
const State& ContactModel::state_with_old_contacts() const {
  return steps(mechanics()).state();
}
std::vector<Contact> ContactModel::wall_contacts() const {
  return steps(mechanics()).wall_contacts();
}
double ContactModel::gravity() const {
  return steps(mechanics()).gravity();
}
Energy ContactModel::energy() const {
  return contact::energy(state_with_old_contacts(), gravity());
}
const LastStep& ContactModel::last_step() const {
  return steps(mechanics()).last_step();
}
std::uint64_t ContactModel::unmoved_steps_at_rest() const {
  return steps(mechanics()).unmoved_steps_at_rest();
}
void ContactModel::set_vessel(const Vessel& vessel) {
  check_intact();
  steps(mechanics()).set_vessel(vessel);
}

// The sum of grain_energy() over all grains, faster: runs ask for it in each step.
Energy energy(const State& state, double gravity) {
  struct KindBody {
    double mass = 0;
    double depth = 0;  // of its centre below its site
  };
  const Eigen::Vector2d down = gravity_direction(state.vessel);
  std::vector<KindBody> bodies;
  for (const grains::Kind& kind : state.grains.kinds) {
    bodies.push_back(
        {.mass = static_cast<double>(kind.shape.size()), .depth = down.dot(kind.shape.centroid())});
  }
  double motion = 0;  // mass times velocity squared
  double depth = 0;   // mass times depth
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    const grains::Particle& grain = state.grains.particles[id];
    if (!grain.present) {
      continue;
    }
    const KindBody& body = bodies[grain.kind];
    const Eigen::Vector2d velocity(state.velocities[id].x, state.velocities[id].y);
    const double spin = state.velocities[id].spin;
    motion += body.mass * (velocity.squaredNorm() + spin * spin / 2);
    const Eigen::Vector2d remainder(state.remainders[id].x, state.remainders[id].y);
    depth += body.mass * (body.depth + down.dot(lattice::position(grain.site())) +
                          down.dot(remainder) / kSpacing);
  }
  return {.kinetic = std::ldexp(motion, -2 * kFractionBits) / 2 / gravity, .potential = -depth};
}

}  // namespace clca::contact
