#include "clca/boltzmann/scheme.hpp"

#include "boltzmann/majorant.hpp"
#include "boltzmann/ogawa_kato.hpp"

namespace clca::boltzmann {

void advance(Gas& gas, const Process& process, std::uint64_t seed, double time, int threads,
             const KeepsOn& keeps_on) {
  if (const auto* literal = std::get_if<OgawaKato>(&process.scheme)) {
    advance_ogawa_kato(gas, process.law, *literal, seed, time, threads, keeps_on);
  } else {
    advance_majorant(gas, process.law, process.shear_rate, seed, time, threads, keeps_on);
  }
}

}  // namespace clca::boltzmann
