#include "run/outlet_counts.hpp"

#include <numeric>

namespace clca::run {

bool counts_apart(const scene::Scene& scene) {
  constexpr std::size_t kMostMeasures = 800;
  constexpr std::size_t kMeasuresOfOutlet = 4;  // besides those of its species
  return scene.outlets.size() * (scene.species.size() + kMeasuresOfOutlet) <= kMostMeasures;
}

std::vector<std::string> discharge_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  if (!counts_apart(scene)) {
    return names;
  }
  for (const scene::Outlet& outlet : scene.outlets) {
    const std::string name = "discharged." + outlet.name;
    if (scene.outlets.size() > 1) {
      names.push_back(name);
    }
    for (const scene::Species& species : scene.species) {
      if (scene.species.size() > 1) {
        names.push_back(name + "." + species.name);
      }
    }
  }
  return names;
}

std::vector<std::uint64_t> discharge_values(const scene::Scene& scene,
                                            const std::vector<std::uint64_t>& particles) {
  std::vector<std::uint64_t> values;
  const auto species = static_cast<std::ptrdiff_t>(scene.species.size());
  for (auto first = particles.begin(); first != particles.end(); first += species) {
    if (scene.outlets.size() > 1) {
      values.push_back(std::accumulate(first, first + species, std::uint64_t{0}));
    }
    if (species > 1) {
      values.insert(values.end(), first, first + species);
    }
  }
  return values;
}

}  // namespace clca::run
