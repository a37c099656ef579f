#pragma once
// What a grain chooses, and who gets a site that several have chosen.

#include <array>
#include <cstdint>
#include <vector>

#include "clca/baxter/baxter_model.hpp"
#include "grains/internal/box.hpp"

namespace clca::baxter {

/// Energies are whole numbers: 1 is 10^-power / kUnit of the energies in docs/baxter.md.
using Energy = std::int64_t;
inline constexpr Energy kUnit = Energy{1} << 20U;

/// Number of velocities: those of grains::Move.
inline constexpr std::size_t kVelocities = lattice::kDirectionCount + 1;

struct Choice {
  std::uint32_t id = 0;
  grains::Move velocity = grains::kRest;
  std::uint16_t axis = 0;
  Energy energy = 0;
};

/// Pure: a choice depends on the state when the step begins and the draws of its grain.
class Rule {
 public:
  /// Throws std::invalid_argument for rules out of range, and unless the kinds are those of
  /// kinds_along_axes().
  Rule(const grains::Box& box, const Rules& rules);

  /// Velocity and axis of least energy. Of equal ones: rest, then the axis it has, then a draw.
  Choice choice(std::uint32_t id) const;
  /// Those of the choices that move: of several that want one site, the one of least energy, and of
  /// equal ones a draw decides.
  std::vector<Choice> winners(const std::vector<Choice>& choices) const;

 private:
  using Energies = std::array<std::array<Energy, kAxes>, kVelocities>;

  bool is_free(lattice::Site site) const;
  /// The velocities that a grain may choose.
  std::array<bool, kVelocities> open(lattice::Site site) const;
  /// Of neighbours alone, by velocity and axis.
  Energies neighbour_energies(lattice::Site site) const;

  const grains::Box& box_;
  std::array<Energy, 4> unlike_velocities_ = {};  // by their distance
  Energy gravity_ = 0;
  Energy like_axes_ = 0;  // in units of kUnit
};

}  // namespace clca::baxter
