#pragma once
// The contact model of a scene in lattice spacings and steps, and these in units of output.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "clca/contact/vessel.hpp"
#include "clca/scene/scene.hpp"

namespace clca::scene {

// Model units of quantities with a mass; UnitConversion::si_unit() gives their SI units.
inline constexpr std::string_view kForceUnit = "weights of a site";
inline constexpr std::string_view kEnergyUnit = "weights of a site × spacings";
inline constexpr std::string_view kMomentUnit = "spacings × weights of a site";
// Units of contact forces: the weight of a grain of mean mass, see contact::mean_grain_mass().
inline constexpr std::string_view kContactForceUnit = "grain weights";
inline constexpr std::string_view kStressUnit = "grain weights/spacing";

/// The SI unit for a unit of the model.
struct SiUnit {
  std::string_view name;
  double factor = 1;  ///< SI value of one unit of the model
};

/// Mass and weight of one site of a grain, in SI units.
struct SiteMass {
  double mass = 0;    ///< kilograms
  double weight = 0;  ///< newtons
};

/// Metres and seconds if the scene has units, else units derived from lattice spacing and gravity.
struct UnitConversion {
  std::string length_unit;                 ///< m or spacing
  std::string time_unit;                   ///< s or √(spacing/gravity)
  std::string velocity_unit;               ///< m/s or √(spacing·gravity)
  double spacing = 1;                      ///< a lattice spacing, in the unit of length
  double time_step = 1;                    ///< in the unit of time
  std::optional<SiteMass> site_mass = {};  ///< if the scene has units with a density
  double mean_mass = 1;  ///< in sites, of a grain: its weight is the unit of contact forces

  /// Time of a step, in the unit of time.
  double time(std::uint64_t steps) const { return static_cast<double>(steps) * time_step; }
  /// `0.3124 s`, with enough decimals to distinguish steps.
  std::string time_text(std::uint64_t steps) const;
  /// From lattice spacings per step to the unit of velocity.
  double velocity(double spacings_per_step) const {
    return spacings_per_step * spacing / time_step;
  }
  /// Kilograms per second of so many sites per step; only with a density.
  double mass_rate(double sites_per_step) const {
    return sites_per_step / time_step * site_mass->mass;
  }
  /// N, J, N m or N/m for the units above; none for other units, or without a density.
  std::optional<SiUnit> si_unit(std::string_view unit) const;
  /// A value given in `unit`, converted to its SI unit if there is one.
  double in_si(double value, std::string_view unit) const;
};

/// Whether the scene has units with a density.
bool has_density(const Scene& scene);

/// For contact scenes; none for other models, whose steps have no length.
std::optional<UnitConversion> unit_conversion(const Scene& scene);

/// A length such as `1 mm` in metres; none for other text.
std::optional<double> metres_in(std::string_view text);

/// Smallest positive number of steps that takes at least `time`, up to rounding.
double steps_until(double time, const UnitConversion& conversion);

/// The parameters of a contact scene. Default fall height: the height of all fills together at a
/// packing fraction of 0.8 in the widest of their regions, or more, so that what falls from the
/// highest fill is no faster than a site a step; that of the box if there are sources without a
/// count, no fills, or a beginning with another run.
contact::Parameters contact_parameters(const Scene& scene);
/// The same in a stage that may have friction and restitution of its own.
contact::Parameters contact_parameters(const Scene& scene, const Stage& stage);

/// Centre of rotation of the vessel in a stage, in lattice spacings; none if it does not turn.
std::optional<Eigen::Vector2d> turning_centre(const Scene& scene, const Stage& stage);

/// The vessel at the start of a stage; the previous stage left it as `before`. Throws
/// std::invalid_argument for a motion too fast or too slow for the time step.
contact::Vessel vessel_at_start(const Scene& scene, const Stage& stage,
                                const contact::Vessel& before);

}  // namespace clca::scene
