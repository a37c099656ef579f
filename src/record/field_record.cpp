// fields.csv: packing, velocity and fluctuation on a grid; distribution of fluctuation energies.

#include <optional>

#include "clca/measure/field_grid.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

struct FieldRow {
  const StageView& now;
  const measure::FieldCell& cell;
  double velocity_unit;  // a spacing per step in the unit of velocities
};

TableOf<FieldRow> fields_table(const scene::Scene& /*scene*/) {
  return {{.name = "fields"},
          {{kStage, [](auto& row) { return row.now.stage.name; }},
           {kStep, [](auto& row) { return row.now.model.state().step; }},
           {kCellCentre, [](auto& row) { return row.cell.centre; }},
           {{"packing", "Packing", "",
             "share of its sites that particles take at the end of the window"},
            [](auto& row) { return row.cell.packing_fraction; }},
           {{"particles", "Particles", "particles",
             "that began the window in the cell and are still in the box; between two cells half "
             "in each. Without one there is no velocity"},
            [](auto& row) { return row.cell.particles; }},
           {kVelocity,
            [](auto& row) {
              return row.cell.particles > 0
                         ? std::optional<Eigen::Vector2d>(row.cell.velocity * row.velocity_unit)
                         : std::nullopt;
            }},
           {kFluctuation, [](auto& row) {
              return row.cell.particles > 0 ? std::optional(row.cell.fluctuation *
                                                            row.velocity_unit * row.velocity_unit)
                                            : std::nullopt;
            }}}};
}

struct EnergyBin {
  double lower = 0;
  std::optional<double> upper = {};
  double share = 0;
  double share_local = 0;
  double reference = 0;
};

TableOf<EnergyBin> fluctuation_table(const scene::Scene& /*scene*/) {
  return {
      {.name = "fluctuation", .kind = TableInfo::Kind::parts},
      {{{"lower", "Lower end of the bin", "", "of the energy X of fluctuations"},
        &EnergyBin::lower},
       {{"upper", "Upper end of the bin", "", "none for the last"}, &EnergyBin::upper},
       {{"share", "Share of the particles", "", "over the mean of the window"}, &EnergyBin::share},
       {{"share_local", "Share of the particles, local", "", "over the mean of the cell"},
        &EnergyBin::share_local},
       {{"reference", "Share under chi-square", "", ""}, &EnergyBin::reference}}};
}

class FieldRecord : public SavedObserver<FieldRecord> {
 public:
  explicit FieldRecord(const scene::Scene& scene)
      : fields_(*scene.output.fields),
        velocity_unit_(velocity_factor(scene)),
        fields_table_(scene, fields_table(scene)),
        fluctuation_table_(scene, fluctuation_table(scene)) {}

  static double bytes(const scene::Scene& scene, double particles) {
    const double side = scene.output.fields->cell_side;
    return 2 * measure::Snapshot::bytes_for(particles) + particles * sizeof(measure::Displacement) +
           measure::field_bytes(scene.box.width * scene.box.height / (side * side));
  }

  void after_step(const StageView& now) override {
    if (now.model.state().step - begin_->step() >= fields_.every) {
      end_window(now);
    }
  }
  /// The last window may be short.
  void end_stage(const StageView& now) override {
    if (now.model.state().step > begin_->step()) {
      end_window(now);
    }
    if (fluctuations_.sample_count() > 0) {
      write_fluctuations(now);
    }
  }
  std::vector<RunTable*> tables() override { return {&fields_table_, &fluctuation_table_}; }

  MeasureValues measures() const {
    const auto distance = [&](const std::vector<double>& shares) {
      const auto reference = statistics::chi_square_shares(fluctuations_.bins(), 2);
      return fluctuations_.sample_count() > 0
                 ? store::MeasureValue(statistics::hellinger_distance(shares, reference))
                 : store::MeasureValue();
    };
    const double energy = steps_ > 0 ? fluctuation_steps_ / static_cast<double>(steps_) : 0;
    return {energy * velocity_unit_ * velocity_unit_,
            distance(fluctuations_.bin_shares()),
            distance(fluctuations_.local_bin_shares()),
            static_cast<double>(fluctuations_.sample_count()),
            fluctuations_.resting_share(),
            fluctuations_.sparse_share()};
  }

  bool precedes(const grains::State& now) const {
    return begin_ && begin_->precedes(now) && fluctuations_.has_all_bins();
  }
  static constexpr const char* kPath = "records/fields";
  CLCA_FIELDS(begin_, fluctuations_, fluctuation_steps_, steps_);

 private:
  void prepare(const StageView& now) override {
    begin_.emplace(now.model.state());
    fluctuations_ = {};
    fluctuation_steps_ = 0;
    steps_ = 0;
  }
  void end_window(const StageView& now) {
    const grains::State& state = now.model.state();
    const std::vector<measure::FieldCell> fields =
        measure::field_cells(*begin_, state, fields_.cell_side);
    for (const measure::FieldCell& cell : fields) {
      if (cell.particles > 0 || cell.packing_fraction > 0) {
        fields_table_.add({now, cell, velocity_unit_});
      }
    }
    const std::uint64_t steps = state.step - begin_->step();
    if (steps == fields_.every) {
      fluctuations_.add(begin_->displacements(state),
                        measure::Grid(state.lattice, fields_.cell_side));
    }
    fluctuation_steps_ += measure::mean_fluctuation(fields) * static_cast<double>(steps);
    steps_ += steps;
    begin_.emplace(state);
  }
  void write_fluctuations(const StageView& now) {
    const statistics::Bins& bins = fluctuations_.bins();
    const std::vector<double> shares = fluctuations_.bin_shares();
    const std::vector<double> local = fluctuations_.local_bin_shares();
    const std::vector<double> reference = statistics::chi_square_shares(bins, 2);
    for (std::size_t bin = 0; bin < bins.count(); ++bin) {
      const bool is_last = bin + 1 == bins.count();
      fluctuation_table_.add({bins.lower(bin),
                              is_last ? std::nullopt : std::optional(bins.upper(bin)), shares[bin],
                              local[bin], reference[bin]});
    }
    fluctuation_table_.write(now.output_folder, now.stage.name);
  }
  scene::FieldOutput fields_;
  double velocity_unit_;                        // a spacing per step in the unit of velocities
  std::optional<measure::Snapshot> begin_;      // of the window
  measure::FluctuationHistogram fluctuations_;  // over the complete windows of the stage
  double fluctuation_steps_ = 0;                // sum of fluctuation x steps
  std::uint64_t steps_ = 0;
  TableWriter<FieldRow> fields_table_;
  TableWriter<EnergyBin> fluctuation_table_;
};

}  // namespace

ObserverFactory fields_observer() {
  return observer_factory<FieldRecord>(
      [](const scene::Scene& scene) { return scene.output.fields.has_value(); },
      {fields_table, fluctuation_table},
      {{{},
        "`output.fields`",
        {{"fluctuation_energy", "Energy of fluctuations", "(spacings/step)²",
          "½⟨|v - ⟨v⟩|²⟩, mean over the particles of all cells and over the steps of all windows"},
         {"fluctuation_hellinger", "Distance from chi-square", "",
          "of the distribution of the fluctuations (Hellinger), over the mean of the window"},
         {"fluctuation_hellinger_local", "Distance from chi-square, local", "",
          "as `fluctuation_hellinger`, over the mean of the cell"},
         {"fluctuation_samples", "Samples of fluctuations", "", "particles × windows"},
         {"fluctuation_resting_share", "Left out: resting", "",
          "in cells that rest or move as one"},
         {"fluctuation_sparse_share", "Left out: sparse", "",
          "in cells of fewer than 5 particles"}},
        [](const StageView& stage) {
          const auto* fields = stage.observers.find<FieldRecord>();
          return fields != nullptr ? fields->measures() : MeasureValues();
        }}});
}

}  // namespace clca::record
