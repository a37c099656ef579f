// mixing-STAGE.csv: which neighbours stay together while they fall.

#include "clca/measure/mixing.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

namespace {

struct MixingRow {
  double diameters;
  const measure::FallenPairs& fallen;
};

TableOf<MixingRow> mixing_table(const scene::Scene& /*scene*/) {
  return {{.name = "mixing", .kind = TableInfo::Kind::parts},
          {{{"fallen_d", "Distance fallen", "mean diameters", "1, 2, ..."}, &MixingRow::diameters},
           {{"fallen", "Distance fallen, mean", "spacings", "of the pairs"},
            [](auto& row) { return row.fallen.fallen / static_cast<double>(row.fallen.pairs); }},
           {{"pairs", "Pairs", "", "that have fallen so far"},
            [](auto& row) { return row.fallen.pairs; }},
           {{"kept", "Neighbours kept", "", "share of the pairs that are still neighbours"},
            [](auto& row) { return row.fallen.kept_share(); }},
           {{"pair_diffusion", "Diffusion of pairs", "spacings",
             "⟨(Δx₁ - Δx₂)²⟩ over 4 times the distance fallen"},
            [](auto& row) { return row.fallen.diffusion(); }}}};
}

class MixingRecord : public SavedObserver<MixingRecord> {
 public:
  explicit MixingRecord(const scene::Scene& scene) : table_(scene, mixing_table(scene)) {}

  static double bytes(const scene::Scene& /*scene*/, double particles) {
    return measure::Mixing::bytes_for(particles);
  }

  void after_step(const StageView& now) override { mixing_.add(now.model.state()); }
  void end_stage(const StageView& now) override {
    for (std::size_t i = 0; i < fallen().size(); ++i) {
      table_.add({static_cast<double>(i + 1), fallen()[i]});
    }
    table_.write(now.output_folder, now.stage.name);
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

  const std::vector<measure::FallenPairs>& fallen() const { return mixing_.fallen_pairs(); }

  bool precedes(const grains::State& now) const { return mixing_.precedes(now); }
  static constexpr const char* kPath = "records/mixing";
  CLCA_FIELDS(mixing_);

 private:
  void prepare(const StageView& now) override { mixing_ = measure::Mixing(now.model.state()); }

  measure::Mixing mixing_;
  TableWriter<MixingRow> table_;
};

MeasureValues mixing(const StageView& stage) {
  const auto& fallen = stage.observers.find<MixingRecord>()->fallen();
  const auto at = [&](std::size_t diameters, double (measure::FallenPairs::*value)() const) {
    return diameters <= fallen.size() ? store::MeasureValue((fallen[diameters - 1].*value)())
                                      : store::MeasureValue();
  };
  return {at(1, &measure::FallenPairs::kept_share), at(10, &measure::FallenPairs::kept_share),
          at(5, &measure::FallenPairs::diffusion)};
}

}  // namespace

ObserverFactory mixing_observer() {
  return observer_factory<MixingRecord>(
      [](const scene::Scene& scene) { return requests_measure(scene, scene::Measure::mixing); },
      {mixing_table},
      {{scene::Measure::mixing,
        "",
        {{"neighbours_kept_1", "Neighbours kept, 1 d", "",
          "share still neighbours when they have fallen one mean diameter"},
         {"neighbours_kept_10", "Neighbours kept, 10 d", "", "after ten"},
         {"pair_diffusion_5", "Diffusion of pairs", "spacings",
          "⟨(Δx₁ - Δx₂)²⟩ over 4 times the distance fallen, at five mean diameters"}},
        mixing}});
}

}  // namespace clca::record
