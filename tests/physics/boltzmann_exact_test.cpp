// The scheme of pairs against tables of an independent prototype (tests/data/boltzmann). Tolerance:
// the mean of M runs within 4 sqrt(SD^2 / M + se^2), with SD the scatter of single runs of 10^4
// particles, of which the table of 100 seeds tells, scaled with N^-1/2.

#include "physics/gas.hpp"

namespace clca::boltzmann_exact_test {
namespace {

using boltzmann::InitialDistribution;

constexpr std::uint64_t kParticles = 100'000;
constexpr int kRuns = 4;

/// What a Hellinger distance of that many particles shows where there is none.
double floor_of(const std::string& quantity, double particles) {
  return quantity.starts_with("DH")
             ? statistics::expected_hellinger_distance(20, static_cast<std::size_t>(particles))
             : 0;
}

class ExactScheme : public ::testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(ExactScheme, AgreesWithTheReferenceTables) {
  const auto [kind, restitution] = GetParam();
  const std::vector<double> times = {1, 5, 10, 15};
  testing::ReferenceTable best("table_exact_N1e6");
  testing::ReferenceTable scatter("table_exact_N1e4");
  const auto all = testing::results(
      {.beginning = {.particle_count = kParticles,
                     .distribution = kind == 1 ? InitialDistribution::gaussian
                                               : InitialDistribution::equal_energy},
       .process = {.law = {.restitution = restitution, .friction = 0.3, .roughness = 0},
                   .scheme = boltzmann::Majorant{},
                   .shear_rate = 0},
       .members = kRuns},
      times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (const std::string quantity : {"Ttr", "Trot", "ncoll", "DHt_q20", "DHr_q20"}) {
      const auto expected = best.at(kind, restitution, times[i], quantity);
      const auto rough = scatter.at(kind, restitution, times[i], quantity);
      const double deviation = rough.standard_error * std::sqrt(rough.runs) *
                               std::sqrt(rough.particles / double{kParticles});
      const double tolerance =
          4 * std::hypot(deviation / std::sqrt(double{kRuns}), expected.standard_error);
      testing::expect_near(
          fmt::format("{} at time {}", quantity, times[i]),
          testing::sample(all[i].at(quantity)).mean - floor_of(quantity, kParticles),
          expected.value - floor_of(quantity, expected.particles), tolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, ExactScheme,
                         ::testing::Combine(::testing::Values(1, 2),
                                            ::testing::Values(0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8,
                                                              0.9, 0.95, 1.0)));

TEST(ExactScheme, CumulantsAndCorrelationsAgreeToo) {
  testing::ReferenceTable best("highprec_eps0.5_N1e6");
  const std::vector<double> times = {1, 5, 15};
  const auto all =
      testing::results({.beginning = {.particle_count = 1'000'000},
                        .process = {.law = {.restitution = 0.5, .friction = 0.3, .roughness = 0},
                                    .scheme = boltzmann::Majorant{},
                                    .shear_rate = 0},
                        .members = 1},
                       times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (const std::string quantity : {"Ttr", "Trot", "ncoll", "a2t", "a2r", "crel", "ori"}) {
      const auto expected = best.at(1, 0.5, times[i], quantity);
      const double deviation = expected.standard_error * std::sqrt(expected.runs);
      testing::expect_near(fmt::format("{} at time {}", quantity, times[i]),
                           all[i].at(quantity).front(), expected.value,
                           4 * std::hypot(deviation, expected.standard_error));
    }
  }
}

}  // namespace
}  // namespace clca::boltzmann_exact_test
