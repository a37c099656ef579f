#include "run/gas_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/boltzmann/closure.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "run/quantities.hpp"

namespace clca::run {

namespace {

using Row = std::vector<store::Cell>;

/// The first cell of each row of a scene with a list of restitutions.
Row begin_row(const scene::BoltzmannScene& scene, double restitution) {
  return scene.lists_restitutions ? Row{restitution} : Row{};
}

std::vector<std::string> begin_columns(const scene::BoltzmannScene& scene) {
  return scene.lists_restitutions ? std::vector<std::string>{"restitution"}
                                  : std::vector<std::string>{};
}

void add_columns(std::vector<std::string>& columns, const std::string& name, bool with_error) {
  columns.push_back(name);
  if (with_error) {
    columns.push_back(name + "_se");
  }
}

void add_cells(Row& row, const statistics::Sample& value, bool with_error) {
  row.emplace_back(value.mean);
  if (with_error) {
    row.emplace_back(value.standard_error);
  }
}

struct NamedEstimate {
  const char* name;
  statistics::Sample value;
};

/// The columns of series.csv at one time, over the ensemble.
std::vector<NamedEstimate> series_estimates(const GasCase& one, std::size_t place, bool sheared) {
  std::vector<std::vector<GasColumn>> members;
  for (const GasMember* member : one.at(place)) {
    members.push_back(member->observations[place].columns(member->observations.front(), sheared));
  }
  std::vector<NamedEstimate> estimates;
  for (std::size_t column = 0; column < members.front().size(); ++column) {
    std::vector<double> values;
    for (const auto& member : members) {
      values.push_back(member[column].value);
    }
    estimates.push_back({members.front()[column].name, statistics::sample(values)});
  }
  return estimates;
}

std::string series_csv(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases) {
  const bool errors = scene.ensemble > 1;
  std::vector<std::string> columns = begin_columns(scene);
  columns.emplace_back("time");
  for (const GasColumn& column : GasObservation().columns({}, scene.shear_rate > 0)) {
    add_columns(columns, column.name, errors);
  }
  store::Table table(columns);
  const std::vector<GasTime> times = gas_times(scene);
  for (const GasCase& one : cases) {
    for (std::size_t i = 0; i < one.observations(); ++i) {
      if (times[i].in_series) {
        Row row = begin_row(scene, one.restitution);
        row.emplace_back(times[i].time);
        for (const NamedEstimate& entry : series_estimates(one, i, scene.shear_rate > 0)) {
          add_cells(row, entry.value, errors);
        }
        table.add_row(std::move(row));
      }
    }
  }
  return table.to_csv();
}

/// Shares of one kind of energy at one time, a row for each bin.
void add_histogram(store::Table& table, const scene::BoltzmannScene& scene, const GasCase& one,
                   std::size_t place, const char* energy,
                   std::vector<double> boltzmann::EnergyShares::*kind) {
  const statistics::Bins bins = bins_of(scene);
  const std::vector<double> reference = statistics::chi_square_shares(bins, kGasDegrees);
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    std::vector<double> values;
    for (const GasMember* member : one.at(place)) {
      values.push_back((member->observations[place].shares.*kind)[bin]);
    }
    const bool open = std::isinf(bins.upper(bin));
    Row row = begin_row(scene, one.restitution);
    row.emplace_back(energy);
    row.emplace_back(bins.lower(bin));
    row.emplace_back(open ? std::numeric_limits<double>::quiet_NaN() : bins.upper(bin));
    add_cells(row, statistics::sample(values), scene.ensemble > 1);
    row.emplace_back(reference[bin]);
    table.add_row(std::move(row));
  }
}

/// None where no case has come so far.
std::string histogram_csv(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases,
                          std::size_t place) {
  std::vector<std::string> columns = begin_columns(scene);
  columns.insert(columns.end(), {"energy", "lower", "upper"});
  add_columns(columns, "share", scene.ensemble > 1);
  columns.emplace_back("reference");
  store::Table table(columns);
  for (const GasCase& one : cases) {
    if (place < one.observations()) {
      add_histogram(table, scene, one, place, "translational",
                    &boltzmann::EnergyShares::translational);
      add_histogram(table, scene, one, place, "rotational", &boltzmann::EnergyShares::rotational);
    }
  }
  return table.to_csv();
}

/// Temperatures by the closed forms, relative to time 0, at the times of the series.
std::string closure_csv(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases) {
  std::vector<std::string> columns = begin_columns(scene);
  columns.insert(columns.end(), {"time", "t_tr", "t_rot"});
  store::Table table(columns);
  for (const GasCase& one : cases) {
    if (one.observations() == 0) {
      continue;
    }
    const boltzmann::Law law = law_of(scene, one.restitution);
    std::vector<double> spins;
    for (const GasMember* member : one.at(0)) {
      spins.push_back(member->observations.front().moments.rotational);
    }
    const boltzmann::Temperatures start = {1, statistics::sample(spins).mean};
    boltzmann::Temperatures now = start;
    double since = 0;
    for (const GasTime& time : gas_times(scene)) {
      now = boltzmann::closure(law, now, time.time - since);
      since = time.time;
      if (time.in_series) {
        Row row = begin_row(scene, one.restitution);
        row.insert(row.end(),
                   {time.time, now.translational,
                    now.rotational / rotational_unit(start.translational, start.rotational)});
        table.add_row(std::move(row));
      }
    }
  }
  return table.to_csv();
}

/// Steady temperature and stresses of smooth spheres in shear, at the begin and the end.
std::string steady_csv(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases) {
  std::vector<std::string> columns = begin_columns(scene);
  columns.insert(columns.end(), {"time", "t_tr", "p_xx", "p_yy", "p_xy"});
  store::Table table(columns);
  for (const GasCase& one : cases) {
    if (one.restitution == 1) {
      continue;  // heats for ever
    }
    const boltzmann::ShearFlow flow = boltzmann::shear_flow(one.restitution, scene.shear_rate);
    for (const double time : {0.0, scene.until}) {
      Row row = begin_row(scene, one.restitution);
      row.insert(row.end(), {time, flow.temperature, flow.p_xx, flow.p_yy, flow.p_xy});
      table.add_row(std::move(row));
    }
  }
  return table.to_csv();
}

std::string histogram_name(const GasTime& time) {
  return store::table_name("histogram", fmt::format("{}", time.time));
}

}  // namespace

const std::vector<Quantity>& gas_quantities() {
  static const std::vector<Quantity> kQuantities = {
      {"restitution", "Restitution ε", "", "normal restitution of the spheres"},
      {"hellinger_floor", "Distance by sampling alone", "",
       "Hellinger distance that a sample without any difference has"},
      {"time", "Time", "1/(π N (2a)² v₀)", "at the end"},
      {"gases", "Gases", "", "members of the ensemble"},
      {"t_tr", "Translational temperature", "", "relative to time 0"},
      {"t_rot", "Rotational temperature", "", "relative to time 0"},
      {"collisions", "Collisions", "", "per particle, since time 0"},
      {"a2_tr", "Second cumulant, velocities", "", "3⟨v⁴⟩/(5⟨v²⟩²) - 1; 0 if normal"},
      {"a2_rot", "Second cumulant, spins", "", "the same of the spins"},
      {"dh_tr", "Distance, translational energy", "", "from chi-square (Hellinger)"},
      {"dh_rot", "Distance, rotational energy", "", "from chi-square (Hellinger)"},
      {"correlation", "Correlation of the energies", "",
       "⟨v²w²⟩/(⟨v²⟩⟨w²⟩) - 1 of speed and spin; 0 if independent"},
      {"alignment", "Alignment of spin and velocity", "", "0 if their angle is random"},
      {"p_xx", "Pressure p_xx", "mean pressure", ""},
      {"p_yy", "Pressure p_yy", "mean pressure", ""},
      {"p_xy", "Shear stress p_xy", "mean pressure", ""}};
  return kQuantities;
}

std::size_t GasCase::observations() const {
  std::size_t most = 0;
  for (const GasMember& member : members) {
    most = std::max(most, member.observations.size());
  }
  return most;
}

std::vector<const GasMember*> GasCase::at(std::size_t place) const {
  std::vector<const GasMember*> those;
  for (const GasMember& member : members) {
    if (place < member.observations.size()) {
      those.push_back(&member);
    }
  }
  return those;
}

std::vector<PlannedFile> gas_files(const scene::BoltzmannScene& scene) {
  std::vector<PlannedFile> files = {{store::table_name("series")}, {store::table_name("closure")}};
  for (const GasTime& time : gas_times(scene)) {
    files.push_back({histogram_name(time)});
  }
  return files;
}

void write_tables(const scene::BoltzmannScene& scene, const std::vector<GasCase>& cases,
                  const store::RunFolder& folder) {
  const auto write = [&](const std::string& name, const std::string& csv) {
    folder.files().write(name, csv);
  };
  write(store::table_name("series"), series_csv(scene, cases));
  const std::vector<GasTime> times = gas_times(scene);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool reached = std::any_of(cases.begin(), cases.end(),
                                     [i](const GasCase& one) { return i < one.observations(); });
    if (times[i].in_histograms && reached) {
      write(histogram_name(times[i]), histogram_csv(scene, cases, i));
    }
  }
  if (scene.shear_rate == 0) {
    write(store::table_name("closure"), closure_csv(scene, cases));
  } else if (scene.friction == 0) {
    write(store::table_name("closure"), steady_csv(scene, cases));
  }
}

std::vector<store::NamedMeasure> gas_measures(const scene::BoltzmannScene& scene,
                                              const GasCase& one) {
  std::vector<store::NamedMeasure> measures = {
      {"restitution", one.restitution},
      {"hellinger_floor", statistics::hellinger_floor(bins_of(scene).count(), scene.particles)}};
  const std::size_t reached = one.observations();
  if (reached == 0) {
    return measures;
  }
  measures.emplace_back("time", gas_times(scene)[reached - 1].time);
  measures.emplace_back("gases", static_cast<double>(one.at(reached - 1).size()));
  for (const NamedEstimate& entry : series_estimates(one, reached - 1, scene.shear_rate > 0)) {
    measures.emplace_back(entry.name, entry.value.mean);
    if (scene.ensemble > 1) {
      measures.emplace_back(fmt::format("{}_se", entry.name), entry.value.standard_error);
    }
  }
  return measures;
}

}  // namespace clca::run
