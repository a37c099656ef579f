#include "clca/lattice/centred.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace clca::lattice {

Shape centred(const Shape& shape) {
  const auto& sites = shape.sites();
  const auto count = static_cast<long long>(sites.size());
  long long sum_x = 0;
  long long sum_q = 0;
  for (const Axial site : sites) {
    sum_x += site.x;
    sum_q += site.q;
  }
  // Squared distance from the centre of mass, times count squared: exact.
  const auto distance = [&](Axial site) {
    const long long x = count * site.x - sum_x;
    const long long q = count * site.q - sum_q;
    return x * x + x * q + q * q;
  };
  const Axial reference = *std::min_element(
      sites.begin(), sites.end(), [&](Axial a, Axial b) { return distance(a) < distance(b); });
  std::vector<Axial> moved;
  for (const Axial site : sites) {
    moved.push_back(site - reference);
  }
  return Shape(std::move(moved));
}

}  // namespace clca::lattice
