// The first slopes of cooling, which closed forms give exactly for a Maxwellian gas, and both
// schemes beside each other, for laws of contact other than those of the tables.

#include <random>

#include "clca/boltzmann/closure.hpp"
#include "physics/gas.hpp"

namespace clca::boltzmann_closed_forms_test {
namespace {

struct Setting {
  boltzmann::Law law;
  double energy_ratio = 1;
};

/// Some that nobody has chosen.
std::vector<Setting> random_settings() {
  std::mt19937 engine(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 0x1p32;
  };
  std::vector<Setting> settings(3);
  for (Setting& setting : settings) {
    setting.law.restitution = uniform(0.2, 1);
    setting.law.friction = uniform(0.05, 1);
    setting.energy_ratio = uniform(0.1, 3);
  }
  settings.back().law.roughness = uniform(-0.8, 0.8);
  return settings;
}

std::string name_of(const Setting& setting) {
  return fmt::format("restitution {:.3f}, friction {:.3g}, roughness {:.3f}, energy ratio {:.3f}",
                     setting.law.restitution, setting.law.friction, setting.law.roughness,
                     setting.energy_ratio);
}

void expect_first_slopes(const Setting& setting) {
  // By then the gas is no longer Maxwellian, by a cumulant of 0.003 at most; that changes the
  // slope by 3/16 of it.
  constexpr double kTime = 0.05;
  constexpr double kDeparture = 1e-3;
  const auto all = testing::results(
      {.beginning = {.particle_count = 50'000, .energy_ratio = setting.energy_ratio},
       .process = {.law = setting.law, .scheme = boltzmann::Majorant{}, .shear_rate = 0},
       .members = 32},
      {kTime});
  const double start = 2.5 * setting.energy_ratio;
  const auto end =
      boltzmann::temperatures_after(setting.law, {.translational = 1, .rotational = start}, kTime);
  const std::map<std::string, double> expected = {{"Ttr", end.translational},
                                                  {"Trot", end.rotational / start}};
  for (const auto& [quantity, value] : expected) {
    testing::expect_mean(quantity + " " + name_of(setting), all.front().at(quantity), value, 0,
                         kDeparture * std::abs(value - 1));
  }
}

TEST(FirstSlopes, OfThePapersCaseAreThoseOfTheClosure) {
  for (const double restitution : {0.5, 1.0}) {
    expect_first_slopes({.law = {.restitution = restitution, .friction = 0.3, .roughness = 0}});
  }
}

TEST(FirstSlopes, OfOtherLawsAreThoseOfTheClosure) {
  for (const Setting& setting : random_settings()) {
    expect_first_slopes(setting);
  }
}

// One partner makes the printed scheme heat no more; what is left of its bias are the collisions
// that a step may not repeat: x^2 / 2 of x, 1.33 steps of them.
TEST(BothSchemes, AgreeForShortStepsAndOnePartner) {
  constexpr double kStep = 0.005;
  constexpr double kTime = 0.5;
  constexpr double kMissing = 1.33 * kStep;
  for (const Setting& setting : random_settings()) {
    const auto run = [&](const boltzmann::Scheme& scheme, int members) {
      return testing::results(
                 {.beginning = {.particle_count = 10'000, .energy_ratio = setting.energy_ratio},
                  .process = {.law = setting.law, .scheme = scheme, .shear_rate = 0},
                  .members = members},
                 {kTime})
          .front();
    };
    const auto exact = run(boltzmann::Majorant{}, 16);
    const auto printed = run(
        boltzmann::OgawaKato{.time_step = kStep, .partner_count = 1, .quasi_random = false}, 16);
    for (const std::string quantity : {"Ttr", "Trot", "ncoll", "a2t", "a2r", "crel"}) {
      const auto expected = testing::sample(exact.at(quantity));
      const double change = quantity == "ncoll"         ? expected.mean
                            : quantity.starts_with("T") ? std::abs(expected.mean - 1)
                                                        : std::abs(expected.mean);
      testing::expect_mean(quantity + " " + name_of(setting), printed.at(quantity), expected.mean,
                           expected.standard_error, kMissing * change);
    }
  }
}

}  // namespace
}  // namespace clca::boltzmann_closed_forms_test
