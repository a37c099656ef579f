#pragma once
// What series.csv says of the steps since its last row: forces on walls, and what has left.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/measure/outflow.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

/// Whether the series has what leaves in kilograms and particles a second.
bool has_flow_rates(const scene::Scene& scene);

class SeriesRecord : public SavedObserver<SeriesRecord> {
 public:
  explicit SeriesRecord(const scene::Scene& scene);

  void after_step(const StageView& now) override;

  /// Names of the columns of the forces: of each wall, then each side of the box.
  static std::vector<std::string> force_names(const scene::Scene& scene);
  /// Their cells; no values without steps.
  std::vector<store::Cell> force_cells() const;
  /// Kilograms and particles a second; none without steps.
  std::optional<double> mass_flow_rate() const;
  std::optional<double> particle_flow_rate() const;

  /// False if this cannot have been recorded in a run that reached `now`.
  bool precedes(const grains::State& now) const;
  static constexpr const char* kPath = "records/series";
  CLCA_FIELDS(steps_, loads_, before_, left_);

 private:
  /// On a wall or a side, summed over the steps, in weights of a site and lattice spacings.
  struct Load {
    double force_x = 0;
    double force_y = 0;
    double torque = 0;  // anticlockwise

    CLCA_FIELDS(force_x, force_y, torque);
  };

  void prepare(const StageView& now) override;
  void clear();
  void add_forces(const grains::State& state, const std::vector<contact::Force>& forces);
  /// What the torque on a body is about.
  Eigen::Vector2d pivot(const grains::State& state, std::size_t body) const;

  scene::Series series_;
  std::optional<scene::Conversion> conversion_;
  std::vector<grains::Owner> bodies_;      // with forces; else empty
  std::vector<Eigen::Vector2d> centres_;   // of each, before walls travelled
  std::optional<Eigen::Vector2d> centre_;  // that the vessel turns about
  std::uint64_t steps_ = 0;
  std::vector<Load> loads_;    // by body
  measure::Discharge before_;  // at the last row
  measure::Discharge left_;    // after the last step
};

}  // namespace clca::record
