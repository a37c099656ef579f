#include "clca/boltzmann/scheme.hpp"

#include <cmath>
#include <stdexcept>

#include "boltzmann/engine/steps.hpp"

namespace clca::boltzmann {

namespace {

void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::invalid_argument(reason);
  }
}

}  // namespace

void check_valid(const Law& law) {
  require(law.restitution >= 0 && law.restitution <= 1 && law.friction >= 0 &&
              std::isfinite(law.friction) && law.roughness >= -1 && law.roughness <= 1,
          "restitution is from 0 to 1, friction not negative, roughness from -1 to 1");
}

void advance(Gas& gas, const Dynamics& process, std::uint64_t seed, double time, int threads,
             const ContinueCondition& keep_going) {
  require(threads >= 1, "the number of threads must be positive");
  require(gas.particle_count() >= 2, "a gas needs at least 2 particles");
  require(std::isfinite(time), "a gas cannot be carried to a time that is not finite");
  require(process.shear_rate >= 0 && std::isfinite(process.shear_rate),
          "a shear rate must not be negative");
  check_valid(process.law);
  const auto* literal = std::get_if<OgawaKato>(&process.scheme);
  require(literal == nullptr || (literal->time_step > 0 && std::isfinite(literal->time_step) &&
                                 literal->partner_count >= 1),
          "time step and number of partners must be positive");
  const std::function<void()> step =
      literal != nullptr
          ? ogawa_kato_stepper(gas, process.law, *literal, seed, time, threads)
          : majorant_stepper(gas, process.law, process.shear_rate, seed, time, threads);
  for (bool goes_on = true; goes_on && gas.time < time;) {
    step();
    goes_on = !keep_going || keep_going(gas);
  }
}

}  // namespace clca::boltzmann
