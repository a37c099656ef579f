// Uniform shear flow of smooth spheres: a kinetic model tells its steady state nearly, the balance
// of energy and the dimensions of the problem tell it exactly.

#include "clca/boltzmann/closure.hpp"
#include "physics/gas.hpp"

namespace clca::boltzmann_shear_test {
namespace {

boltzmann::Dynamics sheared(double restitution, double shear_rate) {
  return {.law = {.restitution = restitution, .friction = 0, .roughness = 0},
          .scheme = boltzmann::Majorant{},
          .shear_rate = shear_rate};
}

/// The rate at which the kinetic model has the temperature 1 of the beginning, so that little is
/// left to relax.
double mild_rate(double restitution) {
  return 1 / std::sqrt(boltzmann::steady_shear_flow(restitution, 1).temperature);
}

/// By then what the temperature differs from the steady one, which goes at the rate 3/8 (1 - e^2)
/// sqrt(T), is down by e^7; a faster flow is hotter and quicker.
double relaxed(double restitution, double shear_rate) {
  return 20 / (1 - restitution * restitution) * mild_rate(restitution) / shear_rate;
}

/// `every` after `begin`, again and again up to `end`.
std::vector<double> regular_times(double begin, double end, double every) {
  std::vector<double> times(static_cast<std::size_t>((end - begin) / every));
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = begin + static_cast<double>(i + 1) * every;
  }
  return times;
}

struct Flow {
  double restitution = 1;
  double shear_rate = 1;
  double every = 1;  ///< time from look to look, and the longest step
  std::uint64_t particles = 5000;
};

/// Each quantity in the steady state, a mean over time for every member of an ensemble.
testing::GasResult steady(const Flow& flow) {
  const std::vector<double> times =
      regular_times(0, 2 * relaxed(flow.restitution, flow.shear_rate), flow.every);
  const auto all =
      testing::results({.beginning = {.particle_count = flow.particles, .energy_ratio = 0},
                        .process = sheared(flow.restitution, flow.shear_rate),
                        .members = 8},
                       times);
  testing::GasResult means;
  for (const std::string quantity : {"Ttr", "Pxx", "Pyy", "Pxy"}) {
    means[quantity] = testing::late_means(all, all.size() / 2, quantity);
  }
  return means;
}

// The model is a series in the inelasticity: at a restitution of 0.9 its temperature is too high
// by 3 %, at 0.6 by 15 %, and its stresses are off by 1 to 4 %.
TEST(ShearFlow, ComesToTheTemperatureAndStressesOfTheKineticModel) {
  for (const double restitution : {0.6, 0.7, 0.8, 0.9}) {
    const double rate = mild_rate(restitution);
    const auto found = steady({.restitution = restitution, .shear_rate = rate, .every = 1});
    const boltzmann::ShearFlow model = boltzmann::steady_shear_flow(restitution, rate);
    const double inelasticity = 1 - restitution * restitution;
    const auto compare = [&](const std::string& quantity, double value, double tolerance) {
      testing::expect_near(fmt::format("{} over that of the model, {}", quantity, restitution),
                           testing::sample(found.at(quantity)).mean / value, 1, tolerance);
    };
    compare("Ttr", model.temperature, inelasticity / 4);
    compare("Pxx", model.p_xx, inelasticity / 12);
    compare("Pyy", model.p_yy, inelasticity / 12);
    compare("Pxy", model.p_xy, inelasticity / 12);
  }
}

/// <|v_a - v_b|^3> of 2 N pairs.
double mean_cube(const boltzmann::Motions& motions) {
  const auto velocities = motions.topRows<3>();
  const Eigen::Index count = motions.cols();
  double sum = 0;
  constexpr int kShifts = 2;
  for (int shift = 1; shift <= kShifts; ++shift) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index other = (i + shift * count / (kShifts + 1)) % count;
      const double square = (velocities.col(i) - velocities.col(other)).square().sum();
      sum += square * std::sqrt(square);
    }
  }
  return sum / static_cast<double>(kShifts * count);
}

// A pair loses (1 - e^2) (g n)^2 / 4, (g n)^2 is g^2 / 2 in the mean, and a particle collides at
// the rate |g|: collisions cool at (1 - e^2) <|g|^3> / 24, whatever the distribution. Shear heats
// at
// -(2/3) a <v_x v_y>.
TEST(ShearFlow, HeatsAsMuchAsCollisionsCoolOnceItIsSteady) {
  for (const double restitution : {0.6, 0.9}) {
    const double rate = mild_rate(restitution);
    const double begin = relaxed(restitution, rate);
    std::vector<double> balances;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      boltzmann::Gas gas = boltzmann::make_gas({.particle_count = 5000, .energy_ratio = 0}, seed);
      double heating = 0;
      double cooling = 0;
      for (const double time : regular_times(begin, 3 * begin, 1)) {
        boltzmann::advance(gas, sheared(restitution, rate), seed, time, 1);
        const auto moments = boltzmann::moments(gas.motions);
        heating += -2.0 / 3 * rate * moments.p_xy * moments.translational;
        cooling += (1 - restitution * restitution) * mean_cube(gas.motions) / 24;
      }
      balances.push_back(heating / cooling);
    }
    testing::expect_mean(fmt::format("heating over cooling, {}", restitution), balances, 1);
  }
}

TEST(ShearFlow, IsFourTimesAsHotAtTwiceTheRate) {
  const auto slow = steady({.restitution = 0.8, .shear_rate = 1, .every = 1});
  const auto fast = steady({.restitution = 0.8, .shear_rate = 2, .every = 0.5});
  const auto expected = testing::sample(slow.at("Ttr"));
  testing::expect_mean("Ttr", fast.at("Ttr"), 4 * expected.mean, 4 * expected.standard_error);
  const auto stress = testing::sample(slow.at("Pxy"));
  testing::expect_mean("Pxy", fast.at("Pxy"), stress.mean, stress.standard_error);
}

// Steps are 0.05 long at the most where the rate is 1.
TEST(ShearFlow, IsTheSameInHalfAsLongSteps) {
  const auto coarse =
      steady({.restitution = 0.7, .shear_rate = 1, .every = 0.05, .particles = 4000});
  const auto fine =
      steady({.restitution = 0.7, .shear_rate = 1, .every = 0.025, .particles = 4000});
  for (const std::string quantity : {"Ttr", "Pxx", "Pyy", "Pxy"}) {
    const auto expected = testing::sample(coarse.at(quantity));
    testing::expect_mean(quantity, fine.at(quantity), expected.mean, expected.standard_error);
  }
}

}  // namespace
}  // namespace clca::boltzmann_shear_test
