#include "clca/measure/outflow.hpp"

#include <algorithm>

namespace clca::measure {

Discharge discharge(const automaton::State& state) {
  Discharge total;
  for (const automaton::Outlet& outlet : state.outlets) {
    total.particles += outlet.particles;
    total.sites += outlet.sites;
  }
  return total;
}

void Outflow::add(Discharge total) {
  last_ = total;
  sites_.push_back(total.sites - begin_.sites);
}

double Outflow::sites_per_step() const {
  if (during_stage().particles < 2) {
    return 0;
  }
  const auto total = static_cast<double>(sites_.back());
  const auto first_after = [&](double share) {
    return std::lower_bound(
        sites_.begin(), sites_.end(), share * total,
        [](std::uint64_t sites, double wanted) { return static_cast<double>(sites) < wanted; });
  };
  const auto from = first_after(0.2);
  const auto to = first_after(0.7);
  return to > from ? static_cast<double>(*to - *from) / static_cast<double>(to - from) : 0;
}

}  // namespace clca::measure
