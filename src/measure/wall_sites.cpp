#include "measure/wall_sites.hpp"

#include <algorithm>

namespace clca::measure {

std::vector<lattice::Site> wall_sites(const grains::State& state) {
  std::vector<lattice::Site> sites;
  for (const grains::Wall& wall : state.walls) {
    if (wall.present) {
      const std::vector<lattice::Site> covered = grains::sites_now(state.lattice, wall);
      sites.insert(sites.end(), covered.begin(), covered.end());
    }
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

}  // namespace clca::measure
