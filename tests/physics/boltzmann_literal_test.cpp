// The scheme as Ogawa & Kato print it against the table that an independent prototype made by the
// same recipe, and what it is known for: it heats a gas that should keep its energy.

#include "physics/gas.hpp"

namespace clca::boltzmann_literal_test {
namespace {

using boltzmann::InitialDistribution;

constexpr std::uint64_t kParticles = 10'000;
constexpr int kRuns = 4;

class PrintedScheme : public ::testing::TestWithParam<std::tuple<int, double>> {};

// Temperatures of the table are relative to the nominal ones, and so are these: draws as they fall,
// means and mean squares not put right.
TEST_P(PrintedScheme, AgreesWithTheReferenceTable) {
  const auto [kind, restitution] = GetParam();
  const std::vector<double> times = {1, 5, 15};
  testing::ReferenceTable table("table_literal_N1e4");
  const auto all = testing::results(
      {.beginning = {.particle_count = kParticles,
                     .distribution = kind == 1 ? InitialDistribution::gaussian
                                               : InitialDistribution::equal_energy,
                     .exact_moments = false},
       .process = {.law = {.restitution = restitution, .friction = 0.3, .roughness = 0},
                   .scheme = boltzmann::OgawaKato{},
                   .shear_rate = 0},
       .members = kRuns},
      times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (const std::string quantity : {"Ttr", "Trot", "ncoll", "DHt_q20", "DHr_q20"}) {
      const auto expected = table.at(kind, restitution, times[i], quantity);
      const double deviation = expected.standard_error * std::sqrt(expected.runs);
      testing::expect_near(
          fmt::format("{} at time {}", quantity, times[i]),
          testing::sample(all[i].at(quantity)).mean, expected.value,
          4 * std::hypot(deviation / std::sqrt(double{kRuns}), expected.standard_error));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PrintedScheme,
                         ::testing::Combine(::testing::Values(1, 2), ::testing::Values(0.5, 1.0)));

TEST(PrintedScheme, HeatsElasticSmoothSpheresBySomeNinePercent) {
  const auto all =
      testing::results({.beginning = {.particle_count = 10'000},
                        .process = {.law = {.restitution = 1, .friction = 0, .roughness = 0},
                                    .scheme = boltzmann::OgawaKato{},
                                    .shear_rate = 0},
                        .members = 8},
                       {15});
  const std::vector<double>& temperatures = all.front().at("Ttr");
  testing::expect_near("heating", testing::sample(temperatures).mean - 1, 0.09, 0.03);
  testing::expect_mean("expected heating", temperatures,
                       1 + boltzmann::expected_heating(boltzmann::OgawaKato{}, 15));
}

}  // namespace
}  // namespace clca::boltzmann_literal_test
