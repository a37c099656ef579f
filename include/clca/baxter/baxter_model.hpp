#pragma once
// Elongated grains that choose velocity and axis by an energy (Baxter & Behringer 1990, 1991).

#include <cstdint>
#include <vector>

#include "clca/grains/model.hpp"

namespace clca::baxter {

using grains::Options;

inline constexpr int kMaxPower = 6;
inline constexpr double kMaxGravity = 1000;

struct Rules {
  int exponent = 3;    ///< exponent of the energy of unlike velocities, 0 to kMaxPower
  double gravity = 3;  ///< energy of a grain that does not go down where it can, to kMaxGravity
  double like_axes_factor = 0.01;  ///< in [0, 1], for the energy of neighbours of equal axes

  bool operator==(const Rules&) const = default;
};

/// Number of axes of a grain: axis a is a times 60 degrees clockwise from the vertical.
inline constexpr std::uint16_t kAxisCount = 3;
/// Kinds 3 s, 3 s + 1 and 3 s + 2 are species s along its three axes.
constexpr std::uint16_t axis_of(const grains::Particle& particle) {
  return particle.kind % kAxisCount;
}
/// These species of one site along all axes, in the order of axis_of().
std::vector<grains::Kind> kinds_along_axes(std::uint16_t species);

/// The velocity of a grain is its last move, its axis is its kind. Takes its steps as it is
/// defined, on one thread, whatever the options.
class BaxterModel : public grains::Model {
 public:
  /// Throws std::invalid_argument if the state is not valid (see grains::check_valid,
  /// grains::check_one_site, grains::Occupancy), its kinds are not those of kinds_along_axes(), a
  /// rule is out of range, or the number of threads is not positive.
  explicit BaxterModel(grains::State state, const Rules& rules = {}, const Options& options = {});

  const grains::State& state() const { return grains(); }
};

}  // namespace clca::baxter
