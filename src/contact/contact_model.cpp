#include "clca/contact/contact_model.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "clca/reflection/hash.hpp"
#include "contact/engine/engine.hpp"
#include "contact/rule/numbers.hpp"
#include "contact/rule/step.hpp"

namespace clca::contact {

namespace {

std::unique_ptr<grains::Mechanics> make_steps(State state, const Parameters& parameters,
                                              const Options& options) {
  check_valid(options);
  if (options.reference) {
    return std::make_unique<Reference>(std::move(state), parameters);
  }
  return std::make_unique<Engine>(std::move(state), parameters, options.phase_times);
}

}  // namespace

double default_fall_height(double box_height) {
  return std::max(kMinFallHeight, box_height);
}

double gravity(const Parameters& parameters) {
  const double value = parameters.resolution * parameters.resolution / (2 * parameters.fall_height);
  if (!(parameters.resolution > 0 && parameters.fall_height > 0 && value <= kMaxGravity &&
        value >= kMinGravity)) {
    throw std::invalid_argument("resolution and fall height do not give a time step");
  }
  return to_fixed_point(value, kFractionBits) / static_cast<double>(kSpacing);  // as steps have it
}

std::uint64_t hash(const State& state) {
  return reflection::hash(state);
}

int needed_columns(const std::vector<grains::Kind>& kinds) {
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
  const auto fail = [](const char* reason) { throw std::invalid_argument(reason); };
  const lattice::Lattice& lattice = state.grains.lattice;
  if (const int needed = needed_columns(state.grains.kinds);
      lattice.periodic() && lattice.columns() < needed) {
    throw std::invalid_argument("two grains may touch on both sides in a periodic box of " +
                                std::to_string(lattice.columns()) + " columns: it needs " +
                                std::to_string(needed));
  }
  if (grains::may_overlap(state.grains)) {
    fail("the contact model lets no walls overlap");
  }
  if (state.wall_remainders.size() != state.grains.walls.size()) {
    fail("there is not one remainder for each wall");
  }
  for (std::size_t number = 0; number < state.wall_remainders.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    const std::int64_t ahead = state.wall_remainders[number];
    if (wall.motion ? !grains::can_be_ahead(*wall.motion, wall.travel, ahead) : ahead != 0) {
      fail("a wall is not where its motion has brought it");
    }
  }
  const std::size_t grains = state.grains.particles.size();
  if (state.velocities.size() != grains || state.remainders.size() != grains ||
      state.from_anchors.size() != grains) {
    fail("there is not one velocity for each grain");
  }
  if (std::any_of(state.from_anchors.begin(), state.from_anchors.end(),
                  [](lattice::Axial from_anchor) { return lattice::length(from_anchor) > 1; })) {
    fail("a grain is too far from its anchor");
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
                       (with_grain ? grains::particle_id(contact.other) < grains &&
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
    for (const Impulse<std::int32_t>& impulse : {contact.impulse, contact.impact}) {
      if (!in_range(impulse.normal, kMaxImpulse) || !in_range(impulse.shear, kMaxImpulse) ||
          !in_range(impulse.rolling, kMaxImpulse)) {
        fail("an impulse is out of range");
      }
    }
    if (contact.impulse.normal < 0 || contact.impulse.normal + contact.impact.normal < 0) {
      fail("an impulse is out of range");
    }
    const auto upper = grains::as_owner(contact.upper);
    pairs.emplace_back(
        static_cast<std::uint32_t>(with_grain ? std::min(upper, contact.other) : upper),
        with_grain ? std::max(upper, contact.other) : contact.other);
  }
  std::sort(pairs.begin(), pairs.end());
  if (std::adjacent_find(pairs.begin(), pairs.end()) != pairs.end()) {
    fail("two bodies have two contacts");
  }
}

double step_bytes(double grains) {
  return grains * Engine::kGrainBytes;
}

ContactModel::ContactModel(State state, const Parameters& parameters, const Options& options)
    : Model(make_steps(std::move(state), parameters, options)) {}

namespace {

Steps& steps(grains::Mechanics& mechanics) {
  return static_cast<Steps&>(mechanics);
}

}  // namespace

const State& ContactModel::state() const {
  steps(mechanics()).write_back();
  return steps(mechanics()).state();
}
std::vector<Contact> ContactModel::wall_contacts() const {
  return steps(mechanics()).wall_contacts();
}
const Vessel& ContactModel::vessel() const {
  return steps(mechanics()).state().vessel;
}
double ContactModel::gravity() const {
  return steps(mechanics()).gravity();
}
bool ContactModel::quiet() const {
  return steps(mechanics()).state().quiet_steps > 1;
}
Energy ContactModel::energy() const {
  steps(mechanics()).write_back_velocities();
  return contact::energy(steps(mechanics()).state(), gravity());
}
const EnergyExchange& ContactModel::exchange() const {
  return steps(mechanics()).exchange();
}
const std::vector<Contact>& ContactModel::pushes() const {
  return steps(mechanics()).cuts().pushes;
}
bool ContactModel::too_fast() const {
  return steps(mechanics()).cuts().too_fast;
}
void ContactModel::set_vessel(const Vessel& vessel) {
  check_whole();
  steps(mechanics()).set_vessel(vessel);
}

}  // namespace clca::contact
