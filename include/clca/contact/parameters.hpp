#pragma once
// Parameters of the contact model.

#include <cstdint>
#include <optional>
#include <vector>

namespace clca::contact {

/// Rotation of grains: none, with rolling resistance, or free.
enum class Rolling : std::uint8_t { none, resistance, free };

/// Of all coefficients of friction: the largest that the rule can tell from more.
inline constexpr double kMaxFriction = 16384;

struct Parameters {
  double friction = 0.4;       ///< between grains
  double wall_friction = 0.4;  ///< of walls that have none of their own, and of the box
  /// By wall: a friction of its own. May be shorter than the list of walls.
  std::vector<std::optional<double>> friction_by_wall = {};
  Rolling rolling = Rolling::resistance;
  /// For Rolling::resistance; multiplied by the radius, as in discrete element models.
  double rolling_friction = 0.5;
  double restitution = 0.4;  ///< in [0, 1)
  int sweeps = 2;            ///< over all contacts in a step, forwards and backwards in turn
  double resolution = 0.4;   ///< sites a step after a fall of the bed's height; sets the time step
  /// Fall height in lattice spacings. 0: estimated, of a scene from its fills
  /// (scene::contact_parameters), else from the height of the box (default_fall_height).
  double fall_height = 0;

  bool operator==(const Parameters&) const = default;
};

}  // namespace clca::contact
