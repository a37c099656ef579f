#pragma once
// Lattice contact dynamics: grains with velocities, friction and rolling on the lattice.

#include <cstdint>
#include <optional>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/model.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::contact {

using grains::Options;

/// Rotation of grains: none, with rolling resistance, or free.
enum class Rolling : std::uint8_t { none, resistance, free };

/// Largest coefficient of friction and of rolling friction, for whole numbers of the rule.
inline constexpr double kMaxFriction = 16384;

struct Parameters {
  double friction = 0.4;       ///< coefficient between grains
  double wall_friction = 0.4;  ///< of walls that have none of their own, and of the box
  /// By wall: its own coefficient; none: wall_friction. May be shorter than the list of walls.
  std::vector<std::optional<double>> friction_by_wall = {};
  Rolling rolling = Rolling::resistance;
  /// For Rolling::resistance: largest moment over the normal force and the reduced radius.
  double rolling_friction = 0.5;
  double restitution = 0.4;  ///< in [0, 1)
  int sweeps = 2;            ///< over all contacts in a step, forwards and backwards in turn
  double resolution = 0.4;   ///< speed after a fall by fall_height, in sites a step: sets gravity()
  /// Fall height in lattice spacings. 0: estimated, of a scene from its fills
  /// (scene::contact_parameters), else the height of the box, but at least kMinFallHeight.
  double fall_height = 0;

  bool operator==(const Parameters&) const = default;
};

// In lattice spacings per step squared.
inline constexpr double kMinGravity = 0x1p-20;
inline constexpr double kMaxGravity = 0.25;

/// Least fall height of estimates, in lattice spacings.
inline constexpr double kMinFallHeight = 10;

/// Gravity in lattice spacings per step squared, a multiple of 2^-23. Throws std::invalid_argument
/// unless resolution and fall height are positive and give kMinGravity to kMaxGravity.
double gravity(const Parameters& parameters);

/// 64-bit hash of everything that a run changes; the same on every machine.
std::uint64_t hash(const State& state);

/// Columns that a periodic box needs so that no two grains of these kinds touch on both sides: more
/// than twice as many as from a grain to one that it touches, an even number.
int min_periodic_columns(const std::vector<grains::Kind>& kinds);

/// Throws std::invalid_argument, with the reason, unless the model can run the state (see
/// grains::check_valid): one motion per grain, contacts of existing bodies, all numbers in range,
/// no wall that may overlap, every wall where its motion can have moved it, and a periodic box of
/// min_periodic_columns() at least.
void check_valid(const State& state);

/// Bytes that the model takes for so many grains, besides their particles.
double step_bytes(double grains);

/// Energy of the grains. Unit: mass of a site x gravity x lattice spacing.
struct Energy {
  double kinetic = 0;
  /// In the present direction of gravity; 0 if all centres of mass are level with site (0, 0).
  double potential = 0;

  double sum() const { return kinetic + potential; }
};

/// `gravity` in lattice spacings per step squared.
Energy energy(const State& state, double gravity);

/// Energy that the grains exchange with all else, in the unit of Energy. What their energy changes
/// by beyond it is dissipated.
struct EnergyExchange {
  double sources = 0;  ///< energy of the grains that enter
  double outlets = 0;  ///< energy of the grains that leave
  double walls = 0;    ///< work of moving walls: their forces on grains times their displacements
  /// Work of a moving vessel: what gravity that turns adds to the potential energy, and the work
  /// of the forces by shaking and of the centrifugal forces.
  double vessel = 0;

  /// Energy that the grains have gained.
  double gained() const { return sources - outlets + walls + vessel; }
  CLCA_FIELDS(sources, outlets, walls, vessel);
  EnergyExchange& operator+=(const EnergyExchange& other) {
    reflection::add_fields(*this, other);
    return *this;
  }
};

/// Results of a step that are not in its state.
struct LastStep {
  EnergyExchange exchange = {};
  /// Collisions of grains that were held up with the bodies in their way, see collide_blocked().
  /// Contact::transient is the impulse, along a direction of the lattice. A pair may have several.
  std::vector<Contact> blocked_collisions = {};
  bool had_too_fast_grain = false;  ///< a grain was faster than it can move, and lost velocity
};

class ContactModel : public grains::Model {
 public:
  /// Throws std::invalid_argument if the state is not valid (see check_valid, grains::Occupancy), a
  /// parameter is out of range, or the number of threads is not positive.
  ContactModel(State state, const Parameters& parameters, const Options& options = {});

  /// Costs more than grains() and state_with_old_contacts(), as it updates the list of contacts.
  const State& state() const;
  /// state(), where the contacts do not matter: they may be those of an earlier step.
  const State& state_with_old_contacts() const;
  /// Contacts of the last step with walls and sides of the box, maybe others, too.
  std::vector<Contact> wall_contacts() const;
  /// In lattice spacings per step squared.
  double gravity() const;
  /// The same as contact::energy() of state(), without the cost of state().
  Energy energy() const;
  const LastStep& last_step() const;
  /// State::unmoved_steps after which the grains count as at rest.
  std::uint64_t unmoved_steps_at_rest() const;

  /// Throws std::invalid_argument for an invalid vessel. Grains at rest stay so in it.
  void set_vessel(const Vessel& vessel);
};

}  // namespace clca::contact
