#include "clca/measure/outflow.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

#include "grains/internal/box.hpp"
#include "measure/places.hpp"

namespace clca::measure {

namespace {

using lattice::Site;

/// From where particles of one kind can fall into an outlet, and where these ways end.
struct FallPaths {
  std::vector<bool> from;  ///< by index of the first site of the shape, which lies in the box
  bool none = true;        ///< there is no room even inside the outlet
  /// At a site below the top of the box all ways up end, and a particle is in one of them.
  bool end_at_particle = false;
  bool reach_top = false;  ///< one of the sites is at the top of the box
};

/// Finds the ways of particles of one kind into one outlet, upwards from it.
class FallPathSearch {
 public:
  FallPathSearch(const grains::State& state, const grains::Occupancy& occupancy, std::uint16_t kind,
                 std::size_t outlet, lattice::Direction down)
      : state_(state),
        occupancy_(occupancy),
        kind_(kind),
        sites_(state.kinds[kind].shape.sites()),
        outlet_(outlet),
        up_({opposite(down), rotated(opposite(down), 1), rotated(opposite(down), -1)}) {
    for (std::size_t way = 0; way < up_.size(); ++way) {
      lead_sites_[way] = state.kinds[kind].shape.lead_sites(up_[way]);
    }
  }

  /// Index of the first site of a particle, whose reference site may lie outside the box.
  std::size_t first_index(Site site) const { return state_.lattice.index(site + sites_.front()); }

  /// `past_particles`: only walls and the sides of the box are in the way. Sites above another
  /// outlet do not count: from there a particle falls into that one.
  FallPaths fall_paths(bool past_particles) const {
    const auto stops = [&](grains::Owner owner) {
      return owner != grains::kFree && !(past_particles && grains::is_particle(owner));
    };
    const std::vector<bool> above_others = this->above_others();
    FallPaths result = {.from = std::vector<bool>(state_.lattice.index_count(), false)};
    std::vector<Site> sites = inside(outlet_);
    std::erase_if(sites, [&](Site site) { return any_owner(site, sites_, stops); });
    result.none = sites.empty();
    for (const Site site : sites) {
      result.from[first_index(site)] = true;
    }
    while (!sites.empty()) {
      const Site site = sites.back();
      sites.pop_back();
      bool ends = true;
      bool below_particle = false;
      for (std::size_t way = 0; way < up_.size(); ++way) {
        if (any_owner(site, lead_sites_[way], stops)) {
          below_particle = below_particle || any_owner(site, lead_sites_[way], grains::is_particle);
          continue;
        }
        ends = false;
        const Site next = moved(site, up_[way]);
        if (!result.from[first_index(next)] && !above_others[first_index(next)]) {
          result.from[first_index(next)] = true;
          sites.push_back(next);
        }
      }
      const bool at_top = any_owner(site, lead_sites_[0],
                                    [](grains::Owner owner) { return owner == grains::kBorder; });
      result.reach_top = result.reach_top || at_top;
      result.end_at_particle = result.end_at_particle || (ends && below_particle && !at_top);
    }
    return result;
  }

 private:
  template <class Test>
  bool any_owner(Site site, const std::vector<lattice::Axial>& parts, Test test) const {
    return std::ranges::any_of(parts, [&](lattice::Axial part) {
      return test(occupancy_.owner(state_.lattice.index(site + part)));
    });
  }

  Site moved(Site site, lattice::Direction direction) const {
    const Site next = site + unit(direction);
    return {state_.lattice.wrapped(next.column), next.row};
  }

  /// Sites from which a particle falls straight into another outlet, past all particles.
  std::vector<bool> above_others() const {
    const auto stops = [](grains::Owner owner) {
      return owner != grains::kFree && !grains::is_particle(owner);
    };
    std::vector<bool> result(state_.lattice.index_count(), false);
    for (std::size_t other = 0; other < state_.outlets.size(); ++other) {
      if (other == outlet_) {
        continue;
      }
      for (Site site : inside(other)) {
        while (!result[first_index(site)]) {
          result[first_index(site)] = true;
          if (any_owner(site, lead_sites_[0], stops)) {
            break;
          }
          site = moved(site, up_[0]);
        }
      }
    }
    return result;
  }

  /// Reference sites of particles that lie wholly inside an outlet and the box.
  std::vector<Site> inside(std::size_t outlet) const {
    const lattice::Lattice& lattice = state_.lattice;
    std::vector<Site> result;
    for (int column = 0; column < lattice.columns(); ++column) {
      for (int row = 0; row < lattice.rows(); ++row) {
        const Site site = Site{column, row} + (lattice::Axial() - sites_.front());
        if (std::ranges::all_of(
                sites_, [&](lattice::Axial part) { return lattice.contains(site + part); }) &&
            enclosing_outlet(state_, {.column = site.column, .row = site.row, .kind = kind_}) ==
                outlet) {
          result.push_back(site);
        }
      }
    }
    return result;
  }

  const grains::State& state_;
  const grains::Occupancy& occupancy_;
  std::uint16_t kind_;
  const std::vector<lattice::Axial>& sites_;
  std::size_t outlet_;
  std::array<lattice::Direction, 3> up_;                   // straight first
  std::array<std::vector<lattice::Axial>, 3> lead_sites_;  // of a move along each of up_
};

}  // namespace

Discharge discharge(const grains::State& state) {
  Discharge total;
  for (const grains::Outlet& outlet : state.outlets) {
    reflection::add_fields(total, discharge(outlet));
  }
  return total;
}

Discharge discharge(const grains::Outlet& outlet) {
  return {.particles = outlet.particles, .sites = outlet.sites};
}

std::vector<std::uint64_t> discharged_counts(const grains::State& state, std::size_t species) {
  std::vector<std::uint64_t> counts(state.outlets.size() * species, 0);
  for (const grains::Particle& particle : state.particles) {
    if (!particle.present) {  // it keeps the position at which it was removed
      const std::size_t outlet = grains::enclosing_outlet(state, particle);
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
  if (stage_discharge().particles < 2 || events_.empty()) {
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
         stage_discharge().particles <= stage_discharge().sites && last.step <= steps_ &&
         last.sites == stage_discharge().sites;
}

bool is_clogged(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
                lattice::Direction down) {
  check_occupancy(state, occupancy);
  static_cast<void>(state.outlets.at(outlet));
  std::vector<std::vector<Site>> sites(state.kinds.size());
  for_each_present(state, [&](std::uint32_t /*id*/, const grains::Particle& particle) {
    sites[particle.kind].push_back(particle.site());
  });
  std::vector<std::uint16_t> kinds(state.kinds.size());
  std::iota(kinds.begin(), kinds.end(), std::uint16_t{0});
  std::ranges::stable_sort(kinds, std::ranges::greater(),
                           [&](std::uint16_t kind) { return state.kinds[kind].shape.size(); });
  for (const std::uint16_t kind : kinds) {
    if (sites[kind].empty()) {
      continue;
    }
    const FallPathSearch search(state, occupancy, kind, outlet, down);
    const FallPaths past = search.fall_paths(true);
    if (std::ranges::any_of(sites[kind],
                            [&](Site site) { return past.from[search.first_index(site)]; })) {
      const FallPaths now = search.fall_paths(false);
      return now.none || now.end_at_particle || (past.reach_top && !now.reach_top);
    }
  }
  return false;
}

}  // namespace clca::measure
