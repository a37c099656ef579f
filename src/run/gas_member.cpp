#include "run/gas_member.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clca::run {

namespace {

class Observer {
 public:
  explicit Observer(const scene::BoltzmannScene& scene)
      : bins_(bins_of(scene)), reference_(boltzmann::chi_square_shares(bins_, kGasDegrees)) {}

  GasObservation operator()(const boltzmann::Gas& gas, bool in_histograms) const {
    GasObservation observation;
    observation.moments = boltzmann::moments(gas.motions);
    observation.collisions = gas.collisions_per_particle();
    boltzmann::EnergyShares shares =
        boltzmann::energy_shares(gas.motions, observation.moments, bins_);
    observation.dh_translational = distance(shares.translational);
    observation.dh_rotational = distance(shares.rotational);
    if (in_histograms) {
      observation.shares = std::move(shares);
    }
    return observation;
  }

 private:
  double distance(const std::vector<double>& shares) const {
    return boltzmann::hellinger_distance(shares, reference_);
  }

  boltzmann::Bins bins_;
  std::vector<double> reference_;
};

}  // namespace

std::vector<GasTime> gas_times(const scene::BoltzmannScene& scene) {
  struct Candidate {
    GasTime time;
    bool is_said;  // by the scene; a multiple may miss it by rounding
  };
  std::vector<Candidate> all = {{{scene.until, true, false}, true}};
  for (const double time : scene.histograms) {
    all.push_back({{time, false, true}, true});
  }
  for (std::uint64_t row = 0; static_cast<double>(row) * scene.series_every < scene.until; ++row) {
    all.push_back({{static_cast<double>(row) * scene.series_every, true, false}, false});
  }
  std::sort(all.begin(), all.end(),
            [](const Candidate& a, const Candidate& b) { return a.time.time < b.time.time; });
  constexpr double kRounding = 1e-9;
  std::vector<GasTime> times;
  for (const Candidate& next : all) {
    if (times.empty() || next.time.time - times.back().time > kRounding * scene.series_every) {
      times.push_back(next.time);
      continue;
    }
    times.back().time = next.is_said ? next.time.time : times.back().time;
    times.back().in_series |= next.time.in_series;
    times.back().in_histograms |= next.time.in_histograms;
  }
  return times;
}

boltzmann::Law law_of(const scene::BoltzmannScene& scene, double restitution) {
  return {.restitution = restitution, .friction = scene.friction, .roughness = scene.roughness};
}

boltzmann::Bins bins_of(const scene::BoltzmannScene& scene) {
  if (const auto* uniform = std::get_if<scene::UniformBins>(&scene.bins)) {
    return boltzmann::Bins::uniform(uniform->width, uniform->end);
  }
  return boltzmann::Bins::equiprobable(std::get<scene::QuantileBins>(scene.bins).count,
                                       kGasDegrees);
}

double relative_temperature(double temperature, double start) {
  return start > 0 ? temperature / start : std::numeric_limits<double>::quiet_NaN();
}

std::vector<GasColumn> GasObservation::columns(const GasObservation& start, bool sheared) const {
  std::vector<GasColumn> columns = {
      {"t_tr", relative_temperature(moments.translational, start.moments.translational)},
      {"t_rot", relative_temperature(moments.rotational, start.moments.rotational)},
      {"collisions", collisions},
      {"a2_tr", moments.a2_translational},
      {"a2_rot", moments.a2_rotational},
      {"dh_tr", dh_translational},
      {"dh_rot", dh_rotational},
      {"correlation", moments.correlation},
      {"alignment", moments.alignment}};
  if (sheared) {
    columns.push_back({"p_xx", moments.p_xx});
    columns.push_back({"p_yy", moments.p_yy});
    columns.push_back({"p_xy", moments.p_xy});
  }
  return columns;
}

GasMember run_member(const scene::BoltzmannScene& scene, double restitution, std::uint64_t seed,
                     int threads, const boltzmann::KeepsOn& keeps_on) {
  const Observer observe(scene);
  const boltzmann::Process process = {
      .law = law_of(scene, restitution), .scheme = scene.scheme, .shear_rate = scene.shear_rate};
  boltzmann::Gas gas = boltzmann::make_gas({.particles = scene.particles,
                                            .initial = scene.initial,
                                            .energy_ratio = scene.energy_ratio,
                                            .exact_moments = scene.exact_moments,
                                            .quasi = scene.quasi},
                                           seed);
  GasMember member;
  for (const GasTime& time : gas_times(scene)) {
    // A cold gas comes from one time to the next in a single step, which nothing can stop.
    if (!keeps_on(gas)) {
      break;
    }
    boltzmann::advance(gas, process, seed, time.time, threads, keeps_on);
    if (gas.time < time.time) {
      break;
    }
    member.observations.push_back(observe(gas, time.in_histograms));
  }
  member.steps = gas.step;
  member.participations = gas.participations;
  member.hash = boltzmann::hash(gas);
  return member;
}

}  // namespace clca::run
