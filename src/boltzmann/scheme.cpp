#include "clca/boltzmann/scheme.hpp"

#include <cmath>
#include <stdexcept>

#include "boltzmann/engine/majorant.hpp"
#include "boltzmann/engine/ogawa_kato.hpp"

namespace clca::boltzmann {

namespace {

void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::invalid_argument(reason);
  }
}

}  // namespace

void advance(Gas& gas, const Process& process, std::uint64_t seed, double time, int threads,
             const ContinueCondition& keep_going) {
  require(threads >= 1, "the number of threads must be positive");
  require(gas.particles() >= 2, "a gas needs at least 2 particles");
  require(std::isfinite(time), "a gas cannot be carried to a time that is not finite");
  require(process.shear_rate >= 0 && std::isfinite(process.shear_rate),
          "a shear rate must not be negative");
  check(process.law);
  if (const auto* literal = std::get_if<OgawaKato>(&process.scheme)) {
    advance_ogawa_kato(gas, process.law, *literal, seed, time, threads, keep_going);
  } else {
    advance_majorant(gas, process.law, process.shear_rate, seed, time, threads, keep_going);
  }
}

}  // namespace clca::boltzmann
