// Rough spheres: the steady share of the spins in the energy where the tangential restitution is
// constant, equipartition where nothing is lost, and the restitution below which friction lets
// the spins outlive the velocities.

#include <algorithm>

#include "physics/gas.hpp"
#include "support/gas_closed_forms.hpp"

namespace clca::boltzmann_rough_test {
namespace {

testing::GasCase gas(const boltzmann::Law& law, double energy_ratio, std::uint64_t particles,
                     int members) {
  return {.beginning = {.particle_count = particles, .energy_ratio = energy_ratio},
          .process = {.law = law, .scheme = boltzmann::Majorant{}, .shear_rate = 0},
          .members = members};
}

/// Ratio of rotational to translational temperature at each time, of the mean over the members.
std::vector<double> ratios(const testing::GasCase& one, const std::vector<double>& times) {
  std::vector<double> found;
  for (const testing::GasResult& result : testing::results(one, times)) {
    found.push_back(one.beginning.energy_ratio * testing::sample(result.at("Trot")).mean /
                    testing::sample(result.at("Ttr")).mean);
  }
  return found;
}

double mean(const std::vector<double>& values) {
  return testing::sample(values).mean;
}

// The closure takes velocities and spins for normal and independent: its ratio is too high, by up
// to 7 % at a restitution of 0.7 and 5 % at 0.9 where the contact sticks, and right within the
// scatter of half a percent where it rebounds nearly whole.
TEST(RoughSpheres, ShareTheirEnergyInTheRatioOfTheClosure) {
  for (const double restitution : {0.7, 0.9}) {
    for (const double roughness : {-0.5, 0.0, 0.5, 0.9}) {
      const double expected = testing::rough_ratio(restitution, roughness);
      const boltzmann::Law law = {.restitution = restitution,
                                  .friction = boltzmann::kNoSlidingLimit,
                                  .roughness = roughness};
      const auto found = ratios(gas(law, expected, 20'000, 4), {30, 35, 40, 45, 50});
      testing::expect_near(fmt::format("restitution {}, roughness {}", restitution, roughness),
                           mean(found) / expected, 0.96, 0.05);
    }
  }
}

TEST(RoughSpheres, WithoutLossComeToEquipartitionAndKeepTheirEnergy) {
  const boltzmann::Law law = {
      .restitution = 1, .friction = boltzmann::kNoSlidingLimit, .roughness = 1};
  boltzmann::Gas gas = boltzmann::make_gas({.particle_count = 100'000, .energy_ratio = 0.2}, 1);
  const auto energy = [&] {
    const auto moments = boltzmann::moments(gas.motions);
    return moments.translational + moments.rotational / 2.5;
  };
  const double before = energy();
  boltzmann::advance(gas, {.law = law, .scheme = boltzmann::Majorant{}, .shear_rate = 0}, 1, 20, 1);
  testing::expect_near("energy", energy() / before, 1, 1e-10);
  const auto moments = boltzmann::moments(gas.motions);
  // Each temperature of that many particles scatters by sqrt(2 / 3 N), against the other.
  testing::expect_near("ratio", moments.rotational / 2.5 / moments.translational, 1,
                       4 * std::sqrt(4.0 / 3 / 1e5));
}

/// Ratio of rotational to translational temperature at times each twice the one before, without
/// the thousandth of the particles that spins fastest. Spins that are fast beside the velocities
/// are hardly braked: from a normal beginning a few stay for ever, and one in 10^4 of them is all
/// rotational energy there is in the end, above the critical restitution too.
std::vector<double> late_ratios(double restitution, boltzmann::InitialDistribution initial) {
  boltzmann::Gas gas = boltzmann::make_gas({.particle_count = 40'000, .distribution = initial}, 1);
  const boltzmann::Law law = {.restitution = restitution, .friction = 0.3, .roughness = 0};
  std::vector<double> found;
  for (const double time : {250, 500, 1000, 2000}) {
    boltzmann::advance(gas, {.law = law, .scheme = boltzmann::Majorant{}, .shear_rate = 0}, 1, time,
                       1);
    Eigen::ArrayXd squares = gas.motions.bottomRows<3>().square().colwise().sum();
    std::sort(squares.begin(), squares.end());
    const double spins = squares.head(gas.particle_count() * 999 / 1000).sum();
    found.push_back(spins / 2.5 / gas.motions.topRows<3>().square().sum());
  }
  return found;
}

TEST(FrictionalSpheres, SpinEverMoreBelowTheCriticalRestitution) {
  for (const double restitution : {0.5, 0.8}) {
    ASSERT_LT(restitution, testing::critical_restitution(0.3));
    const auto found = late_ratios(restitution, boltzmann::InitialDistribution::gaussian);
    for (std::size_t i = 1; i < found.size(); ++i) {
      EXPECT_GT(found[i], 1.3 * found[i - 1]) << restitution;
    }
  }
}

// Which ratio, the beginning does not matter for.
TEST(FrictionalSpheres, ComeToOneRatioOfEnergiesAboveTheCriticalRestitution) {
  for (const double restitution : {0.9, 0.95}) {
    ASSERT_GT(restitution, testing::critical_restitution(0.3));
    const auto normal = late_ratios(restitution, boltzmann::InitialDistribution::gaussian);
    const auto equal = late_ratios(restitution, boltzmann::InitialDistribution::equal_energy);
    for (std::size_t i = 0; i < normal.size(); ++i) {
      for (const double ratio : {normal[i], equal[i]}) {
        testing::expect_near(fmt::format("ratio {} {} over the last", restitution, i),
                             ratio / equal.back(), 1, 0.03);
      }
    }
  }
}

}  // namespace
}  // namespace clca::boltzmann_rough_test
