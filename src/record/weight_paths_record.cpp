// weight_paths-STAGE.csv: pressure below a bed at rest, by rules and of the contact model.

#include <cmath>
#include <numeric>

#include "clca/measure/weight_paths.hpp"
#include "record/internal/contact_record.hpp"

namespace clca::record {

namespace {

/// Pressures on the base at the end of a stage: by each rule; last, by forces of the contact model.
struct BasePressures {
  measure::BedBase base;
  std::vector<std::vector<double>> shares = {};  ///< measure::base_pressures
  std::vector<std::size_t> outside = {};         ///< measure::WeightPaths, of the rules
  std::size_t unsupported = 0;
};

BasePressures base_pressures(const StageView& stage) {
  const grains::State& state = stage.model.state();
  const auto supported = measure::supported_grains(state, stage.model.grains().occupancy());
  BasePressures result = {.base = measure::bed_base(state)};
  const auto add = [&](const std::vector<contact::Force>& forces) {
    result.shares.push_back(base_pressures(result.base, forces));
  };
  for (const measure::WeightRule rule : measure::kWeightRules) {
    const measure::WeightPaths paths = weight_paths(state, supported, rule);
    add(paths.forces);
    result.outside.push_back(paths.one_sided_grains);
    result.unsupported = paths.unsupported_grains;
  }
  if (const auto* contacts = stage.observers.find<ContactRecord>()) {
    add(contacts->stage_mean_forces(stage.model));
  }
  return result;
}

struct BaseRow {
  double position;
  double x;
  std::vector<std::optional<double>> shares;
};

/// The value of a column: that of the rule, or behind all rules of the contact model.
template <std::size_t kRule>
std::optional<double> share(const BaseRow& row) {
  return row.shares[kRule];
}

TableOf<BaseRow> weight_paths_table(const scene::Scene& scene) {
  return {
      {.name = "weight_paths", .kind = TableInfo::Kind::parts},
      {{{"base_position", "Position on the base", "", "-1 at its left end, 1 at its right end"},
        &BaseRow::position},
       {{"x", "Position", "spacings", "of the middle of the bin"}, &BaseRow::x},
       {{"pressure_inner", "Base pressure, inner", "",
         "over its mean; force to the nearest supports on either side"},
        share<0>},
       {{"pressure_outer", "Base pressure, outer", "", "to the farthest"}, share<1>},
       {{"pressure_pair", "Base pressure, pair", "", "to drawn ones"}, share<2>},
       {{"pressure_q", "Base pressure, q", "", "to all, in drawn shares"}, share<3>}},
      {{kContactModel,
        is_contact_model(scene),
        {{{"pressure_contact", "Base pressure, contact model", "", "of its forces"}, share<4>}}}}};
}

class WeightPathsRecord : public Observer {
 public:
  explicit WeightPathsRecord(const scene::Scene& scene)
      : table_(scene, weight_paths_table(scene)) {}

  static double bytes(const scene::Scene& /*scene*/, double particles) {
    return measure::weight_paths_bytes(particles);
  }

  void end_stage(const StageView& now) override {
    const BasePressures pressures = base_pressures(now);
    const double bin = pressures.base.width() / measure::BedBase::kBinCount;
    for (std::size_t i = 0; i < measure::BedBase::kBinCount; ++i) {
      const double middle = static_cast<double>(i) + 0.5;
      BaseRow row = {
          2 * middle / measure::BedBase::kBinCount - 1, pressures.base.left + middle * bin, {}};
      for (const std::vector<double>& shares : pressures.shares) {
        row.shares.push_back(shares.empty() ? std::nullopt : std::optional(shares[i]));
      }
      table_.add(row);
    }
    table_.write(now.output_folder, now.stage.name);
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

 private:
  TableWriter<BaseRow> table_;
};

store::MeasureValue centre_minus_ring(const std::vector<double>& shares) {
  return shares.empty() ? store::MeasureValue() : measure::centre_minus_ring(shares);
}

MeasureValues values_of_weight_rules(const StageView& stage) {
  const BasePressures pressures = base_pressures(stage);
  const auto grains = static_cast<double>(grains::present_count(stage.model.state()));
  MeasureValues result;
  for (std::size_t rule = 0; rule < measure::kWeightRules.size(); ++rule) {
    result.push_back(centre_minus_ring(pressures.shares[rule]));
  }
  const auto add_share = [&](std::size_t count) {
    result.push_back(grains > 0 ? store::MeasureValue(static_cast<double>(count) / grains)
                                : store::MeasureValue());
  };
  for (std::size_t rule = 0; measure::kWeightRules[rule] != measure::WeightRule::q; ++rule) {
    add_share(pressures.outside[rule]);
  }
  add_share(pressures.unsupported);
  return result;
}

store::MeasureValue deviation(const std::vector<double>& one, const std::vector<double>& other) {
  if (one.empty() || other.empty()) {
    return {};
  }
  const double squares =
      std::transform_reduce(one.begin(), one.end(), other.begin(), 0.0, std::plus(),
                            [](double a, double b) { return (a - b) * (a - b); });
  return std::sqrt(squares / static_cast<double>(one.size()));
}

MeasureValues values_of_contact_forces(const StageView& stage) {
  if (!is_contact_model(stage.scene)) {
    return {};
  }
  const BasePressures pressures = base_pressures(stage);
  MeasureValues result = {centre_minus_ring(pressures.shares.back())};
  for (std::size_t rule = 0; rule < measure::kWeightRules.size(); ++rule) {
    result.push_back(deviation(pressures.shares[rule], pressures.shares.back()));
  }
  return result;
}

constexpr std::string_view kOutside =
    "share of the grains with no support on one side of their force";
constexpr std::string_view kDeviation =
    "from that of the forces, over its mean: root mean square over the 13 bins";

}  // namespace

ObserverFactory weight_paths_observer() {
  return observer_factory<WeightPathsRecord>(
      [](const scene::Scene& scene) {
        return requests_measure(scene, scene::Measure::weight_paths);
      },
      {weight_paths_table},
      {{scene::Measure::weight_paths,
        "",
        {{"centre_minus_ring_inner", "Centre minus ring, inner", "",
          "base pressure in the middle of 13 bins, less the mean of the three next to it on either "
          "side, over the mean of all; force to the nearest supports"},
         {"centre_minus_ring_outer", "Centre minus ring, outer", "", "to the farthest supports"},
         {"centre_minus_ring_pair", "Centre minus ring, pair", "", "to drawn supports"},
         {"centre_minus_ring_q", "Centre minus ring, q", "", "to all supports in drawn shares"},
         {"outside_inner", "Outside, inner", "", kOutside},
         {"outside_outer", "Outside, outer", "", kOutside},
         {"outside_pair", "Outside, pair", "", kOutside},
         {"unsupported", "Without support", "", "share of the grains, where their force ends"}},
        values_of_weight_rules},
       {scene::Measure::weight_paths,
        "model `contact`",
        {{"centre_minus_ring_contact", "Centre minus ring, contact model", "", "of its forces"},
         {"base_deviation_inner", "Deviation of the base pressure, inner", "", kDeviation},
         {"base_deviation_outer", "Deviation of the base pressure, outer", "", kDeviation},
         {"base_deviation_pair", "Deviation of the base pressure, pair", "", kDeviation},
         {"base_deviation_q", "Deviation of the base pressure, q", "", kDeviation}},
        values_of_contact_forces}});
}

}  // namespace clca::record
