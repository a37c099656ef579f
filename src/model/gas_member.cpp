#include "model/internal/gas_member.hpp"

#include <algorithm>

#include "clca/scene/parse.hpp"

namespace clca::model {

std::vector<ObservationTime> observation_times(const scene::BoltzmannScene& scene) {
  struct SortedTime {
    ObservationTime time;
    bool is_said;  // by the scene; a multiple may miss it by rounding
  };
  std::vector<SortedTime> all = {{{scene.end_time, true, false}, true}};
  for (const double time : scene.histogram_times) {
    all.push_back({{time, false, true}, true});
  }
  for (std::uint64_t row = 0; static_cast<double>(row) * scene.series_interval < scene.end_time;
       ++row) {
    all.push_back({{static_cast<double>(row) * scene.series_interval, true, false}, false});
  }
  std::ranges::sort(
      all, [](const SortedTime& a, const SortedTime& b) { return a.time.time < b.time.time; });
  std::vector<ObservationTime> times;
  for (const SortedTime& next : all) {
    if (times.empty() ||
        next.time.time - times.back().time > scene::kTimeTolerance * scene.series_interval) {
      times.push_back(next.time);
      continue;
    }
    times.back().time = next.is_said ? next.time.time : times.back().time;
    times.back().in_series |= next.time.in_series;
    times.back().in_histograms |= next.time.in_histograms;
  }
  return times;
}

std::size_t shared_time_count(const std::vector<ObservationTime>& one,
                              const std::vector<ObservationTime>& other) {
  const auto same = [](const ObservationTime& a, const ObservationTime& b) {
    return a.time == b.time && a.in_histograms == b.in_histograms;
  };
  const auto [end, _] = std::mismatch(one.begin(), one.end(), other.begin(), other.end(), same);
  return static_cast<std::size_t>(end - one.begin());
}

std::size_t lasting_time_count(const scene::BoltzmannScene& scene) {
  scene::BoltzmannScene longer = scene;
  longer.end_time += 2 * scene.series_interval;
  return shared_time_count(observation_times(scene), observation_times(longer));
}

statistics::Bins energy_bins(const scene::BoltzmannScene& scene) {
  if (const auto* uniform = std::get_if<scene::UniformBins>(&scene.bins)) {
    return statistics::Bins::uniform(uniform->width, uniform->last_bin_start);
  }
  return statistics::Bins::equiprobable(std::get<scene::QuantileBins>(scene.bins).count,
                                        kGasDegrees);
}

double rotational_temperature_unit(double translational, double rotational) {
  return rotational > 0 ? rotational : translational;
}

void GasMember::record_counts() {
  steps = gas->step;
  participations = gas->participations;
  hash = boltzmann::hash(*gas);
}

GasIntegrator::GasIntegrator(const scene::BoltzmannScene& scene)
    : scene_(scene),
      times_(observation_times(scene)),
      lasting_times_(lasting_time_count(scene)),
      keeps_lasting_(scene::retained_gas_bytes(scene) > 0),
      bins_(energy_bins(scene)),
      reference_shares_(statistics::chi_square_shares(bins_, kGasDegrees)) {}

void GasIntegrator::integrate(GasMember& member, double restitution, std::uint64_t seed,
                              int threads,
                              const std::function<bool(const GasMember&)>& keep_going) const {
  if (member.observations.size() == times_.size()) {
    return;
  }
  if (!member.gas) {
    member.gas = boltzmann::make_gas(scene::initial_condition(scene_), seed);
  }
  const boltzmann::Dynamics process = scene::gas_process(scene_, restitution);
  boltzmann::Gas& gas = *member.gas;
  // A cold gas may take a single step between two times, which cannot be interrupted.
  while (member.observations.size() < times_.size() && keep_going(member)) {
    const ObservationTime& next = times_[member.observations.size()];
    boltzmann::advance(gas, process, seed, next.time, threads,
                       [&](const boltzmann::Gas& /*gas*/) { return keep_going(member); });
    if (gas.time < next.time) {
      break;
    }
    member.observations.push_back(observe(gas, next.in_histograms));
    if (keeps_lasting_ && member.observations.size() == lasting_times_) {
      member.lasting = member.gas;
    }
  }
  member.record_counts();
  if (member.observations.size() == times_.size()) {
    member.gas.reset();
  }
}

GasObservation GasIntegrator::observe(const boltzmann::Gas& gas, bool in_histograms) const {
  GasObservation observation;
  observation.moments = boltzmann::moments(gas.motions);
  observation.collisions = gas.collisions_per_particle();
  boltzmann::EnergyShares shares =
      boltzmann::energy_shares(gas.motions, observation.moments, bins_);
  observation.dh_translational =
      statistics::hellinger_distance(shares.translational, reference_shares_);
  observation.dh_rotational = statistics::hellinger_distance(shares.rotational, reference_shares_);
  if (in_histograms) {
    observation.shares = std::move(shares);
  }
  return observation;
}

}  // namespace clca::model
