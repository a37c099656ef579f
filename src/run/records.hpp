#pragma once
// What is gathered step by step while a stage runs, for its measures, tables and pictures.

#include <optional>

#include "clca/automaton/automaton.hpp"
#include "clca/scene/scene.hpp"
#include "run/cycle_record.hpp"
#include "run/field_record.hpp"
#include "run/force_record.hpp"

namespace clca::run {

class Records {
 public:
  explicit Records(const scene::Scene& scene);

  void begin_stage(const scene::Stage& stage, const automaton::Automaton& automaton);
  void after_step(const automaton::Automaton& automaton, std::uint64_t steps_in_stage);
  void end_stage(const automaton::Automaton& automaton);

  const CycleRecord& cycles() const { return cycles_; }
  const std::optional<FieldRecord>& fields() const { return fields_; }
  /// None where no wall lets overlap.
  const std::optional<ForceRecord>& forces() const { return forces_; }

 private:
  const scene::Scene& scene_;
  CycleRecord cycles_;
  std::optional<FieldRecord> fields_;
  std::optional<ForceRecord> forces_;
};

/// True when some wall of the scene moves and lets particles overlap.
bool has_overlaps(const scene::Scene& scene);

}  // namespace clca::run
