// Gases refuse what they cannot be carried with.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "clca/boltzmann/closure.hpp"
#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann::preconditions_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(AGas, IsCarriedByAtLeastOneThreadToAFiniteTime) {
  Gas gas = make_gas({.particle_count = 100}, 1);
  for (const Scheme& scheme : {Scheme(Majorant{}), Scheme(OgawaKato{})}) {
    const Dynamics process = {.law = {}, .scheme = scheme};
    EXPECT_THROW(advance(gas, process, 1, 0.1, 0), std::invalid_argument);
    EXPECT_THROW(advance(gas, process, 1, 0.1, -2), std::invalid_argument);
    EXPECT_THROW(advance(gas, process, 1, kNaN, 1), std::invalid_argument);
    EXPECT_THROW(advance(gas, process, 1, kInfinity, 1), std::invalid_argument);
    EXPECT_THROW(advance(gas, {.law = {}, .scheme = scheme, .shear_rate = -1}, 1, 0.1, 1),
                 std::invalid_argument);
    Gas empty;
    EXPECT_THROW(advance(empty, process, 1, 0.1, 1), std::invalid_argument);
  }
  EXPECT_EQ(gas.step, 0U);
}

TEST(ALaw, HasNumbersInRange) {
  for (const Law& wrong :
       {Law{.restitution = -0.1}, Law{.restitution = 1.1}, Law{.restitution = kNaN},
        Law{.friction = -1}, Law{.friction = kNaN}, Law{.roughness = -2}, Law{.roughness = 2}}) {
    EXPECT_THROW(check_valid(wrong), std::invalid_argument);
    EXPECT_THROW(temperatures_after(wrong, {}, 1), std::invalid_argument);
    Gas gas = make_gas({.particle_count = 100}, 1);
    EXPECT_THROW(advance(gas, {.law = wrong, .scheme = {}}, 1, 0.1, 1), std::invalid_argument);
  }
  EXPECT_NO_THROW(check_valid({.restitution = 0.9, .friction = kNoSlidingLimit, .roughness = -1}));
  EXPECT_THROW(temperatures_after({}, {}, kNaN), std::invalid_argument);
  EXPECT_THROW(temperatures_after({}, {}, kInfinity), std::invalid_argument);
}

TEST(AScheme, HasTimeStepsAndPartners) {
  Gas gas = make_gas({.particle_count = 100}, 1);
  for (const OgawaKato& wrong :
       {OgawaKato{.time_step = 0}, OgawaKato{.time_step = kNaN}, OgawaKato{.time_step = kInfinity},
        OgawaKato{.partner_count = 0}}) {
    EXPECT_THROW(advance(gas, {.law = {}, .scheme = wrong}, 1, 0.1, 1), std::invalid_argument);
  }
}

TEST(ABeginning, HasARatioOfEnergiesThatIsNotNegative) {
  for (const double wrong : {-1.0, kNaN, kInfinity}) {
    EXPECT_THROW(make_gas({.particle_count = 10, .energy_ratio = wrong}, 1), std::invalid_argument);
  }
  EXPECT_THROW(make_gas({.particle_count = 1}, 1), std::invalid_argument);
  EXPECT_THROW(make_gas({.particle_count = std::uint64_t{1} << 32U}, 1), std::invalid_argument);
}

TEST(Moments, AreOfAtLeastOneParticle) {
  EXPECT_THROW(moments(Motions()), std::invalid_argument);
}

}  // namespace
}  // namespace clca::boltzmann::preconditions_test
