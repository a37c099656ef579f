#pragma once
// What has left, counted apart by outlet and species.

#include <cstdint>
#include <string>
#include <vector>

#include "clca/scene/scene.hpp"

namespace clca::run {

/// False with so many outlets and species that run.json would have too many measures.
bool counts_apart(const scene::Scene& scene);

/// `discharged.OUTLET` where there are several outlets, each followed by
/// `discharged.OUTLET.SPECIES` where there are several species. None unless counts_apart().
std::vector<std::string> discharge_names(const scene::Scene& scene);

/// The values of these names, from those of measure::discharged_particles.
std::vector<std::uint64_t> discharge_values(const scene::Scene& scene,
                                            const std::vector<std::uint64_t>& particles);

}  // namespace clca::run
