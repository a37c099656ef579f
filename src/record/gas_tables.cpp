#include "record/internal/gas_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/boltzmann/closure.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

using GasScene = scene::BoltzmannScene;
using statistics::SampleStatistics;

constexpr std::string_view kWithShear = "with shear";
constexpr std::string_view kWithList = "with a list of `restitution`";

constexpr Quantity kRestitution = {"restitution", "Restitution ε", "",
                                   "normal restitution of the spheres"};
constexpr Quantity kGasTime = {"time", "Time", "1/(π N (2a)² v₀)", ""};
constexpr Quantity kTranslational = {"t_tr", "Translational temperature", "",
                                     "⟨v²⟩/3, relative to time 0"};
constexpr Quantity kRotational = {
    "t_rot", "Rotational temperature", "",
    "⟨w²⟩/3, relative to time 0; without spin then, to the translational one"};
constexpr Quantity kPressureXx = {"p_xx", "Pressure p_xx", "mean pressure", "3⟨v_x²⟩/⟨v²⟩"};
constexpr Quantity kPressureYy = {"p_yy", "Pressure p_yy", "mean pressure", "3⟨v_y²⟩/⟨v²⟩"};
constexpr Quantity kShearStress = {"p_xy", "Shear stress p_xy", "mean pressure", "3⟨v_x v_y⟩/⟨v²⟩"};

/// What is observed of a gas at a time, with its first observation.
struct ObservedGas {
  const model::GasObservation& now;
  const model::GasObservation& start;
};
struct GasValue {
  Quantity quantity;
  double (*of)(const ObservedGas& gas);
  bool only_with_shear = false;
};

const std::vector<GasValue>& gas_values() {
  using Gas = const ObservedGas&;
  static const std::vector<GasValue> kValues = {
      {kTranslational,
       [](Gas gas) { return gas.now.moments.translational / gas.start.moments.translational; }},
      {kRotational,
       [](Gas gas) {
         return gas.now.moments.rotational /
                model::rotational_temperature_unit(gas.start.moments.translational,
                                                   gas.start.moments.rotational);
       }},
      {{"collisions", "Collisions", "", "of a particle since time 0, mean"},
       [](Gas gas) { return gas.now.collisions; }},
      {{"a2_tr", "Second cumulant, velocities", "", "3⟨v⁴⟩/(5⟨v²⟩²) - 1; 0 if normal"},
       [](Gas gas) { return gas.now.moments.a2_translational; }},
      {{"a2_rot", "Second cumulant, spins", "", "as `a2_tr`, of the spins"},
       [](Gas gas) { return gas.now.moments.a2_rotational; }},
      {{"dh_tr", "Hellinger distance, translational energy", "", "from chi-square"},
       [](Gas gas) { return gas.now.dh_translational; }},
      {{"dh_rot", "Hellinger distance, rotational energy", "", "from chi-square"},
       [](Gas gas) { return gas.now.dh_rotational; }},
      {{"correlation", "Correlation of the energies", "",
        "⟨v²w²⟩/(⟨v²⟩⟨w²⟩) - 1 of speed and spin; 0 if independent"},
       [](Gas gas) { return gas.now.moments.correlation; }},
      {{"alignment", "Alignment of spin and velocity", "",
        "(3⟨(v w)²⟩ - ⟨v²w²⟩)/(⟨v²⟩⟨w²⟩): above 0 where spins lie along velocities, below where "
        "across"},
       [](Gas gas) { return gas.now.moments.alignment; }},
      {kPressureXx, [](Gas gas) { return gas.now.moments.p_xx; }, true},
      {kPressureYy, [](Gas gas) { return gas.now.moments.p_yy; }, true},
      {kShearStress, [](Gas gas) { return gas.now.moments.p_xy; }, true}};
  return kValues;
}

bool has_value(const GasScene& scene, const GasValue& value) {
  return !value.only_with_shear || scene.shear_rate > 0;
}

/// Mean of a value over the ensemble, with its error.
SampleStatistics estimate(const GasCase& gas_case, std::size_t number, const GasValue& value) {
  std::vector<double> values;
  for (const model::GasMember* member : gas_case.members_with(number)) {
    values.push_back(value.of({member->observations[number], member->observations.front()}));
  }
  return statistics::sample_statistics(values);
}

struct GasRow {
  const GasCase& gases;
  std::size_t number;  // of the observation
  double time;
};

TableOf<GasRow> gas_series_table(const GasScene& scene) {
  std::vector<ColumnGroup<GasRow>> columns = {
      {kWithList,
       scene.has_restitution_list,
       {{kRestitution, [](auto& row) { return row.gases.restitution; }}}},
      {"", true, {{kGasTime, &GasRow::time}}}};
  for (const GasValue& value : gas_values()) {
    columns.push_back({value.only_with_shear ? kWithShear : "",
                       has_value(scene, value),
                       {{value.quantity,
                         [&value](auto& row) { return estimate(row.gases, row.number, value); }}}});
  }
  return {{.name = "series", .kind = TableInfo::Kind::whole}, {}, columns};
}

struct GasBin {
  double restitution;
  std::string energy;
  double lower;
  std::optional<double> upper;
  SampleStatistics share;
  double reference;
};

TableOf<GasBin> gas_histogram_table(const GasScene& scene) {
  return {{.name = "histogram", .kind = TableInfo::Kind::parts},
          {},
          {{kWithList, scene.has_restitution_list, {{kRestitution, &GasBin::restitution}}},
           {"",
            true,
            {{{"energy", "Energy", "", "`translational` or `rotational`"}, &GasBin::energy},
             {{"lower", "Lower end of the bin", "", "of X = v²/T_tr or w²/T_rot at the time"},
              &GasBin::lower},
             {{"upper", "Upper end of the bin", "", "none for the last"}, &GasBin::upper},
             {{"share", "Share of the particles", "", ""}, &GasBin::share},
             {{"reference", "Share under chi-square", "", ""}, &GasBin::reference}}}}};
}

struct GasClosure {
  double restitution = 0;
  double time = 0;
  double translational = 0;
  double rotational = 0;
  double p_xx = 0;
  double p_yy = 0;
  double p_xy = 0;
};

TableOf<GasClosure> gas_closure_table(const GasScene& scene) {
  return {
      {.name = "closure", .kind = TableInfo::Kind::whole},
      {},
      {{kWithList, scene.has_restitution_list, {{kRestitution, &GasClosure::restitution}}},
       {"", true, {{kGasTime, &GasClosure::time}, {kTranslational, &GasClosure::translational}}},
       {"without shear", scene.shear_rate == 0, {{kRotational, &GasClosure::rotational}}},
       {kWithShear,
        scene.shear_rate > 0,
        {{kPressureXx, &GasClosure::p_xx},
         {kPressureYy, &GasClosure::p_yy},
         {kShearStress, &GasClosure::p_xy}}}}};
}

using GasSeries = TableWriter<GasRow>;
using GasHistogram = TableWriter<GasBin>;
using Closure = TableWriter<GasClosure>;

void add_bins(GasHistogram& table, const GasScene& scene, const GasCase& gas_case,
              std::size_t number, const char* energy,
              std::vector<double> boltzmann::EnergyShares::*kind) {
  const statistics::Bins bins = model::energy_bins(scene);
  const std::vector<double> reference = statistics::chi_square_shares(bins, model::kGasDegrees);
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    std::vector<double> values;
    for (const model::GasMember* member : gas_case.members_with(number)) {
      values.push_back((member->observations[number].shares.*kind)[bin]);
    }
    table.add({.restitution = gas_case.restitution,
               .energy = energy,
               .lower = bins.lower(bin),
               .upper = std::isinf(bins.upper(bin)) ? std::nullopt : std::optional(bins.upper(bin)),
               .share = statistics::sample_statistics(values),
               .reference = reference[bin]});
  }
}

/// Temperatures by the closed forms, at the times of the series.
void add_cooling(Closure& table, const GasScene& scene, const GasCase& gas_case) {
  if (gas_case.observation_count() == 0) {
    return;
  }
  const boltzmann::Law law = scene::gas_process(scene, gas_case.restitution).law;
  std::vector<double> spins;
  for (const model::GasMember* member : gas_case.members_with(0)) {
    spins.push_back(member->observations.front().moments.rotational);
  }
  const boltzmann::Temperatures start = {1, statistics::sample_statistics(spins).mean};
  boltzmann::Temperatures now = start;
  double since = 0;
  for (const model::ObservationTime& time : model::observation_times(scene)) {
    now = boltzmann::temperatures_after(law, now, time.time - since);
    since = time.time;
    if (time.in_series) {
      table.add({.restitution = gas_case.restitution,
                 .time = time.time,
                 .translational = now.translational,
                 .rotational = now.rotational / model::rotational_temperature_unit(
                                                    start.translational, start.rotational)});
    }
  }
}

/// Steady temperature and stresses of smooth spheres in shear, at the begin and the end.
void add_steady_flow(Closure& table, const GasScene& scene, const GasCase& gas_case) {
  if (gas_case.restitution == 1) {
    return;  // heats for ever
  }
  const boltzmann::ShearFlow flow =
      boltzmann::steady_shear_flow(gas_case.restitution, scene.shear_rate);
  for (const double time : {0.0, scene.end_time}) {
    table.add({.restitution = gas_case.restitution,
               .time = time,
               .translational = flow.temperature,
               .p_xx = flow.p_xx,
               .p_yy = flow.p_yy,
               .p_xy = flow.p_xy});
  }
}

}  // namespace

std::vector<TableInfo> gas_tables() {
  return {gas_series_table({}).info(), gas_histogram_table({}).info(),
          gas_closure_table({}).info()};
}

std::vector<Quantity> gas_quantities() {
  std::vector<Quantity> all = {kRestitution,
                               {"hellinger_floor", "Distance by sampling alone", "",
                                "Hellinger distance that a sample without any difference has"},
                               kGasTime,
                               {"gases", "Gases", "", "members of the ensemble"}};
  for (const GasValue& value : gas_values()) {
    all.push_back(value.quantity);
  }
  return all;
}

std::size_t GasCase::observation_count() const {
  std::size_t most = 0;
  for (const model::GasMember& member : members) {
    most = std::max(most, member.observations.size());
  }
  return most;
}

std::vector<const model::GasMember*> GasCase::members_with(std::size_t observation) const {
  std::vector<const model::GasMember*> those;
  for (const model::GasMember& member : members) {
    if (observation < member.observations.size()) {
      those.push_back(&member);
    }
  }
  return those;
}

std::vector<store::TableSummary> gas_table_summaries(const GasScene& scene) {
  return {{"series", GasSeries(scene, gas_series_table(scene)).column_descriptions()},
          {"histogram", GasHistogram(scene, gas_histogram_table(scene)).column_descriptions()},
          {"closure", Closure(scene, gas_closure_table(scene)).column_descriptions()}};
}

void write_gas_tables(const GasScene& scene, const std::vector<GasCase>& cases,
                      const store::OutputFolder& folder) {
  const std::vector<model::ObservationTime> times = model::observation_times(scene);
  GasSeries series(scene, gas_series_table(scene));
  for (const GasCase& gas_case : cases) {
    for (std::size_t i = 0; i < gas_case.observation_count(); ++i) {
      if (times[i].in_series) {
        series.add({gas_case, i, times[i].time});
      }
    }
  }
  series.write(&folder);
  GasHistogram histogram(scene, gas_histogram_table(scene));
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (const GasCase& gas_case : cases) {
      if (times[i].in_histograms && i < gas_case.observation_count()) {
        add_bins(histogram, scene, gas_case, i, "translational",
                 &boltzmann::EnergyShares::translational);
        add_bins(histogram, scene, gas_case, i, "rotational", &boltzmann::EnergyShares::rotational);
      }
    }
    if (!histogram.has_no_new_rows()) {
      histogram.write(&folder, fmt::format("{}", times[i].time));
    }
  }
  const bool is_smooth = scene.friction == 0 || scene.roughness == -1;
  if (scene.shear_rate == 0 || is_smooth) {
    Closure closure(scene, gas_closure_table(scene));
    for (const GasCase& gas_case : cases) {
      (scene.shear_rate == 0 ? add_cooling : add_steady_flow)(closure, scene, gas_case);
    }
    closure.write(&folder);
  }
}

std::vector<store::NamedMeasure> gas_measures(const GasScene& scene, const GasCase& gas_case) {
  std::vector<store::NamedMeasure> measures = {
      {"restitution", gas_case.restitution},
      {"hellinger_floor", statistics::expected_hellinger_distance(model::energy_bins(scene).count(),
                                                                  scene.particles)}};
  const std::size_t reached = gas_case.observation_count();
  if (reached == 0) {
    return measures;
  }
  measures.emplace_back("time", model::observation_times(scene)[reached - 1].time);
  measures.emplace_back("gases", static_cast<double>(gas_case.members_with(reached - 1).size()));
  for (const GasValue& value : gas_values()) {
    if (has_value(scene, value)) {
      const SampleStatistics mean = estimate(gas_case, reached - 1, value);
      measures.emplace_back(value.quantity.key, mean.mean);
      if (scene.ensemble_size > 1) {
        measures.emplace_back(fmt::format("{}_se", value.quantity.key), mean.standard_error);
      }
    }
  }
  return measures;
}

}  // namespace clca::record
