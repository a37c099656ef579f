#pragma once
// Data gathered during a stage, for its measures, tables and pictures.

#include <optional>

#include "clca/measure/mixing.hpp"
#include "clca/reflection/columns.hpp"
#include "clca/scene/scene.hpp"
#include "run/contact_record.hpp"
#include "run/cycle_record.hpp"
#include "run/energy_record.hpp"
#include "run/field_record.hpp"
#include "run/force_record.hpp"
#include "run/line_record.hpp"
#include "run/model.hpp"

namespace clca::run {

class Records {
 public:
  explicit Records(const scene::Scene& scene);

  void begin_stage(const scene::Stage& stage, const Model& model);
  void after_step(const scene::Stage& stage, const Model& model, std::uint64_t steps_in_stage);
  void end_stage(const Model& model);

  const CycleRecord& cycles() const { return cycles_; }
  const std::optional<FieldRecord>& fields() const { return fields_; }
  /// None without lines, or without the steps at which they are observed.
  const std::optional<LineRecord>& lines() const { return lines_; }
  /// None unless the scene asks for it.
  const std::optional<measure::Mixing>& mixing() const { return mixing_; }
  /// New rows of cycles.csv and, if requested, fields.csv.
  store::Table& cycle_rows() { return cycles_.table(); }
  store::Table* field_rows() { return fields_ ? &fields_->table() : nullptr; }
  /// None if no wall may overlap particles.
  const std::optional<ForceRecord>& forces() const { return forces_; }
  // Contact model only.
  const std::optional<ContactRecord>& contacts() const { return contacts_; }
  std::optional<EnergyRecord>& energy() { return energy_; }
  const std::optional<EnergyRecord>& energy() const { return energy_; }

  void save(reflection::Columns& columns) const;
  /// Resumes a stage. Throws reflection::Mismatch for data that no run which reached this state can
  /// have recorded.
  void resume_stage(const scene::Stage& stage, const Model& model,
                    const reflection::Columns& columns, double max_bytes);

 private:
  const scene::Scene& scene_;
  CycleRecord cycles_;
  std::optional<FieldRecord> fields_;
  std::optional<LineRecord> lines_;
  std::optional<measure::Mixing> mixing_;
  std::optional<ForceRecord> forces_;
  std::optional<ContactRecord> contacts_;
  std::optional<EnergyRecord> energy_;
};

/// True if some wall of the scene moves and may overlap particles.
bool has_overlaps(const scene::Scene& scene);

}  // namespace clca::run
