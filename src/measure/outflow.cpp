#include "clca/measure/outflow.hpp"

#include <algorithm>

#include "grains/internal/box.hpp"
#include "lattice/internal/require.hpp"

namespace clca::measure {

Discharge discharge(const grains::State& state) {
  Discharge total;
  for (const grains::Outlet& outlet : state.outlets) {
    total.particles += outlet.particles;
    total.sites += outlet.sites;
  }
  return total;
}

Discharge discharge(const grains::Outlet& outlet) {
  return {.particles = outlet.particles, .sites = outlet.sites};
}

std::vector<std::uint64_t> discharged_particles(const grains::State& state, std::size_t species) {
  std::vector<std::uint64_t> counts(state.outlets.size() * species, 0);
  for (const grains::Particle& particle : state.particles) {
    if (!particle.present) {  // it keeps the position at which it was removed
      const std::size_t outlet = grains::outlet_around(state, particle);
      require(outlet < state.outlets.size(), "a particle that has left lies in no outlet");
      ++counts[outlet * species + state.kinds[particle.kind].species];
    }
  }
  return counts;
}

void Outflow::add(Discharge total) {
  ++steps_;
  add_at_start(total);
}

void Outflow::add_at_start(Discharge total) {
  require(total.particles >= last_.particles && total.sites >= last_.sites,
          "what has left a box cannot become less");
  if (total.sites != last_.sites) {
    events_.push_back({.step = steps_, .sites = total.sites - begin_.sites});
  }
  last_ = total;
}

double Outflow::sites_per_step() const {
  if (during_stage().particles < 2 || events_.empty()) {
    return 0;
  }
  const auto total = static_cast<double>(events_.back().sites);
  const auto first_after = [&](double share) {
    return *std::ranges::lower_bound(events_, share * total, {}, [](const Event& event) {
      return static_cast<double>(event.sites);
    });
  };
  const Event from = first_after(0.2);
  const Event to = first_after(0.7);
  return to.step > from.step
             ? static_cast<double>(to.sites - from.sites) / static_cast<double>(to.step - from.step)
             : 0;
}

bool Outflow::precedes(Discharge now) const {
  const bool in_order =
      std::ranges::adjacent_find(events_, [](const Event& one, const Event& next) {
        return one.step >= next.step || one.sites >= next.sites;
      }) == events_.end();
  const Event last = events_.empty() ? Event() : events_.back();
  return in_order && last_.particles == now.particles && last_.sites == now.sites &&
         begin_.particles <= last_.particles && begin_.sites <= last_.sites &&
         during_stage().particles <= during_stage().sites && last.step <= steps_ &&
         last.sites == during_stage().sites;
}

}  // namespace clca::measure
