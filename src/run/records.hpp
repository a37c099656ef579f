#pragma once
// What is gathered step by step while a stage runs, for its measures, tables and pictures.

#include <optional>

#include "clca/fields/columns.hpp"
#include "clca/scene/scene.hpp"
#include "run/contact_record.hpp"
#include "run/cycle_record.hpp"
#include "run/energy_record.hpp"
#include "run/field_record.hpp"
#include "run/force_record.hpp"
#include "run/model.hpp"

namespace clca::run {

class Records {
 public:
  explicit Records(const scene::Scene& scene);

  void begin_stage(const scene::Stage& stage, const Model& model);
  void after_step(const scene::Stage& stage, const Model& model, const Model::Report& report,
                  std::uint64_t steps_in_stage);
  void end_stage(const Model& model);

  const CycleRecord& cycles() const { return cycles_; }
  const std::optional<FieldRecord>& fields() const { return fields_; }
  /// The rows of cycles.csv and, where there is one, fields.csv that came since they were taken.
  store::Table& cycle_rows() { return cycles_.table(); }
  store::Table* field_rows() { return fields_ ? &fields_->table() : nullptr; }
  /// None where no wall lets overlap.
  const std::optional<ForceRecord>& forces() const { return forces_; }
  // Of the contact model.
  const std::optional<ContactRecord>& contacts() const { return contacts_; }
  std::optional<EnergyRecord>& energy() { return energy_; }
  const std::optional<EnergyRecord>& energy() const { return energy_; }

  void save(fields::Columns& columns) const;
  /// Goes on with a stage. Throws fields::Mismatch for what no run can have recorded that has come
  /// to the state of `automaton`.
  void resume_stage(const scene::Stage& stage, const Model& model, const fields::Columns& columns,
                    double most_bytes);

 private:
  const scene::Scene& scene_;
  CycleRecord cycles_;
  std::optional<FieldRecord> fields_;
  std::optional<ForceRecord> forces_;
  std::optional<ContactRecord> contacts_;
  std::optional<EnergyRecord> energy_;
};

/// True when some wall of the scene moves and lets particles overlap.
bool has_overlaps(const scene::Scene& scene);

}  // namespace clca::run
