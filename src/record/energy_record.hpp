#pragma once
// Energy balance of a stage of the contact model (contact::Energy), and whether its bed settles.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "record/internal/observer.hpp"

namespace clca::record {

/// Finds a bed that does not settle, by the few grains that move on.
class UnsettledBedDetector {
 public:
  static constexpr std::size_t kMaxMovers = 3;
  static constexpr std::uint64_t kMinSteps = 2000;

  /// Call after a step in which `moved` grains have moved. Returns a warning once, if for kSteps
  /// steps the same grains (at most kMaxMovers) were the only ones that moved, none has gone down
  /// or flown up, and one has moved beyond a neighbouring site and back.
  std::optional<std::string> add_step(const scene::Scene& scene, const grains::State& state,
                                      std::size_t moved);

  CLCA_FIELDS(movers_, steps_, has_advanced_, has_warned_);
  /// False for what no run that reached the state can have recorded.
  bool precedes(const grains::State& state) const;

 private:
  struct Mover {
    std::uint32_t id = 0;
    std::int32_t column = 0;  // of its anchor, which follows as in contact::State
    std::int32_t row = 0;
    std::int32_t lowest = 0;  // row
    std::uint64_t moves = 0;

    CLCA_FIELDS(id, column, row, lowest, moves);
  };

  void begin_anew();
  void add_move(const grains::State& state, std::uint32_t id);

  std::vector<Mover> movers_;
  std::uint64_t steps_ = 0;  // since they alone move
  bool has_advanced_ = false;
  bool has_warned_ = false;
};

class EnergyRecord : public SavedObserver<EnergyRecord> {
 public:
  explicit EnergyRecord(const scene::Scene& /*scene*/) {}

  /// Warns of growing energy, of grains that fall too fast, and of a bed that does not settle.
  void after_step(const StageView& now) override;

  void begin(const scene::Stage& stage, const model::SceneModel& model);
  /// `exchange`: of the step. Once in a run, the text of a warning if the energy has grown by more
  /// than 1 % of its scale: the greatest of the energy at the start, the dissipated and the kinetic
  /// energy, and the energy of a fall of all grains by a lattice spacing.
  std::optional<std::string> add_step(const model::SceneModel& model,
                                      const contact::EnergyExchange& exchange);

  /// Since the start of the stage.
  const contact::EnergyExchange& exchanged() const { return exchanged_; }
  /// Initial energy of the stage plus what the grains have gained since, minus the energy now.
  double dissipated_energy(const contact::Energy& now) const;

  /// Largest rise above an earlier minimum over the scale of add_step(); none unless is_closed_.
  std::optional<double> energy_growth() const;

  static constexpr const char* kPath = "records/energy";
  CLCA_FIELDS(is_closed_, start_, fall_, exchanged_, lowest_, growth_, has_warned_,
              has_been_too_fast_, rest_);
  bool precedes(const grains::State& state) const { return rest_.precedes(state); }

 private:
  void prepare(const StageView& now) override { begin(now.stage, now.model); }

  bool is_closed_ = true;  // no sources, neither walls nor vessel move
  double start_ = 0;       // energy at the start of the stage
  double fall_ = 0;        // energy of a fall of all grains by a lattice spacing
  contact::EnergyExchange exchanged_;
  double lowest_ = 0;  // energy of the stage less what came from outside, at its lowest
  double growth_ = 0;  // greatest rise above it, as a share of the scale of add()
  bool has_warned_ = false;
  bool has_been_too_fast_ = false;
  UnsettledBedDetector rest_;  // of the stage
};

}  // namespace clca::record
