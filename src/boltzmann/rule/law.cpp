#include "clca/boltzmann/law.hpp"

#include <cmath>
#include <stdexcept>

namespace clca::boltzmann {

void check(const Law& law) {
  const bool in_range = law.restitution >= 0 && law.restitution <= 1 && law.friction >= 0 &&
                        std::isfinite(law.friction) && law.roughness >= -1 && law.roughness <= 1;
  if (!in_range) {
    throw std::invalid_argument(
        "restitution is from 0 to 1, friction not negative, roughness from -1 to 1");
  }
}

}  // namespace clca::boltzmann
