#pragma once
// The energy balance of a stage of the contact model, in units of contact::Energy.

#include <cstdint>
#include <optional>

#include "clca/fields/fields.hpp"
#include "clca/scene/scene.hpp"
#include "run/model.hpp"

namespace clca::run {

class EnergyRecord {
 public:
  void begin_stage(const scene::Stage& stage, const Model& model);
  /// Call after each step, which left `report`.
  void after_step(const Model& model, const Model::Report& report, std::uint64_t steps_in_stage);
  /// Takes the last look at a stage.
  void end_stage(const Model& model);

  /// Kinetic and potential energy at the start of the stage and what sources brought since, less
  /// what outlets took and what there is now.
  double dissipated(const contact::Energy& now) const;

  /// What has grown by more than 0.5 % of the start. Told once in a run.
  struct Growth {
    double start = 0;   ///< of the stage
    double lowest = 0;  ///< since then
    double now = 0;
  };
  std::optional<Growth> take_warning();
  /// The largest growth above the lowest before, over the energy at the start; none where sources,
  /// walls or the vessel did work, or there was no energy.
  std::optional<double> growth() const;

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(
        field("is_closed", &EnergyRecord::is_closed_), field("start", &EnergyRecord::start_),
        field("gained", &EnergyRecord::gained_), field("lowest", &EnergyRecord::lowest_),
        field("growth", &EnergyRecord::growth_), field("has_warned", &EnergyRecord::has_warned_));
  }

 private:
  void look(const Model& model);

  bool is_closed_ = true;  // no sources, neither walls nor vessel move
  double start_ = 0;
  double gained_ = 0;  // since then, by sources and outlets
  double lowest_ = 0;
  double growth_ = 0;
  bool has_warned_ = false;
  std::optional<Growth> warning_;
};

}  // namespace clca::run
