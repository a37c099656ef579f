// Smooth inelastic spheres: Haff's law of cooling and the second cumulant of the cooling state,
// beside what an independent prototype measured. Tolerances: 4 standard errors of the mean over
// the ensemble.

#include "physics/gas.hpp"
#include "support/gas_closed_forms.hpp"

namespace clca::boltzmann_smooth_test {
namespace {

/// From time 10 on, 10 collisions and more per particle, the cooling state has been reached.
const std::vector<double> kTimes = {10, 15, 20, 25, 30, 35, 40};

testing::GasCase smooth(double restitution) {
  return {.beginning = {.particle_count = 30'000, .energy_ratio = 0},
          .process = {.law = {.restitution = restitution, .friction = 0, .roughness = 0},
                      .scheme = boltzmann::Majorant{},
                      .shear_rate = 0},
          .members = 16};
}

struct Cooling {
  double restitution;
  double rate;          ///< 1 / tau, measured: the slope of T^-1/2
  double a2 = 0;        ///< measured
  double a2_error = 0;  ///< 0 where there is no measurement
};

class SmoothSpheres : public ::testing::TestWithParam<Cooling> {};

TEST_P(SmoothSpheres, CoolByHaffsLaw) {
  const Cooling expected = GetParam();
  const auto all = testing::results(smooth(expected.restitution), kTimes);
  std::vector<double> rates;
  for (std::size_t member = 0; member < all.front().at("Ttr").size(); ++member) {
    const double begin = 1 / std::sqrt(all.front().at("Ttr")[member]);
    const double end = 1 / std::sqrt(all.back().at("Ttr")[member]);
    rates.push_back((end - begin) / (kTimes.back() - kTimes.front()));
  }
  testing::expect_mean("1/tau", rates, expected.rate);
  const std::vector<double> a2 = testing::late_means(all, 0, "a2t");
  if (expected.a2_error > 0) {
    testing::expect_mean("a2", a2, expected.a2, expected.a2_error);
  }
  // The rate that theory ties to the cumulant just found.
  const double theory =
      1 / std::sqrt(testing::haff_temperature(expected.restitution, 1, testing::sample(a2).mean)) -
      1;
  testing::expect_mean("1/tau by its a2", rates, theory, 0, 2e-3 * theory);
}

INSTANTIATE_TEST_SUITE_P(
    Restitutions, SmoothSpheres,
    ::testing::Values(Cooling{0.2, 0.36927, 0.1282, 6e-4}, Cooling{0.3, 0.34886},
                      Cooling{0.5, 0.28473, 0.0477, 3e-4}, Cooling{0.7, 0.19177},
                      Cooling{0.8, 0.13492, -0.0146, 3e-4}, Cooling{0.9, 0.07129, -0.0154, 3e-4},
                      Cooling{0.95, 0.03659}));

}  // namespace
}  // namespace clca::boltzmann_smooth_test
