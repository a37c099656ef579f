#include "clca/measure/clogging.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "grains/internal/footprint.hpp"
#include "grains/internal/outlet.hpp"
#include "measure/check_occupancy.hpp"

namespace clca::measure {

namespace {

using lattice::Site;

/// The places from which a particle can fall into an outlet.
struct Ways {
  std::vector<bool> from;  ///< by index of the reference site
  bool none = true;        ///< not even inside the outlet is room
  /// Somewhere below the top of the box there is no way further up, as particles are in one.
  bool end_at_particle = false;
  bool reach_top = false;  ///< of the box
};

class Search {
 public:
  Search(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
         lattice::Direction down)
      : state_(state),
        occupancy_(occupancy),
        footprints_(state, {}),
        outlet_(outlet),
        up_({opposite(down), rotated(opposite(down), 1), rotated(opposite(down), -1)}) {}

  /// `past_particles`: only walls and the sides of the box are in the way. Places above another
  /// outlet do not count: from there a particle falls into that one.
  Ways ways(std::uint16_t kind, bool past_particles) const {
    const auto stops = [&](grains::Owner owner) {
      return owner != grains::kFree && !(past_particles && grains::is_particle(owner));
    };
    const std::vector<bool> above_others = this->above_others(kind);
    Ways result = {.from = std::vector<bool>(state_.lattice.index_count(), false)};
    std::vector<Site> places = inside(kind, outlet_);
    std::erase_if(places, [&](Site site) {
      return any_owner(site, footprints_.of(kind, site.column).body, stops);
    });
    result.none = places.empty();
    for (const Site site : places) {
      result.from[state_.lattice.index(site)] = true;
    }
    while (!places.empty()) {
      const Site site = places.back();
      places.pop_back();
      const auto& lead = footprints_.of(kind, site.column).lead;
      bool ends = true;
      bool below_particle = false;
      for (const lattice::Direction direction : up_) {
        if (any_owner(site, lead[index_of(direction)], stops)) {
          below_particle =
              below_particle || any_owner(site, lead[index_of(direction)], grains::is_particle);
          continue;
        }
        ends = false;
        const Site next = moved(site, direction);
        const std::size_t place = state_.lattice.index(next);
        if (!result.from[place] && !above_others[place]) {
          result.from[place] = true;
          places.push_back(next);
        }
      }
      const bool at_top = any_owner(site, lead[index_of(up_[0])],
                                    [](grains::Owner owner) { return owner == grains::kBorder; });
      result.reach_top = result.reach_top || at_top;
      result.end_at_particle = result.end_at_particle || (ends && below_particle && !at_top);
    }
    return result;
  }

 private:
  template <class Test>
  bool any_owner(Site site, const std::vector<lattice::Offset>& offsets, Test test) const {
    const std::size_t place = state_.lattice.index(site);
    return std::any_of(offsets.begin(), offsets.end(), [&](lattice::Offset offset) {
      return test(occupancy_.owner(state_.lattice.at(place, site.column, offset)));
    });
  }

  Site moved(Site site, lattice::Direction direction) const {
    const Site next = site + unit(direction);
    return {state_.lattice.wrapped(next.column), next.row};
  }

  /// Places from which a particle falls straight into another outlet, past all particles.
  std::vector<bool> above_others(std::uint16_t kind) const {
    const auto stops = [](grains::Owner owner) {
      return owner != grains::kFree && !grains::is_particle(owner);
    };
    std::vector<bool> result(state_.lattice.index_count(), false);
    for (std::size_t other = 0; other < state_.outlets.size(); ++other) {
      if (other == outlet_) {
        continue;
      }
      for (Site site : inside(kind, other)) {
        while (!result[state_.lattice.index(site)]) {
          result[state_.lattice.index(site)] = true;
          if (any_owner(site, footprints_.of(kind, site.column).lead[index_of(up_[0])], stops)) {
            break;
          }
          site = moved(site, up_[0]);
        }
      }
    }
    return result;
  }

  /// Where a particle would lie wholly inside an outlet and the box.
  std::vector<Site> inside(std::uint16_t kind, std::size_t outlet) const {
    const lattice::Lattice& lattice = state_.lattice;
    const auto& sites = state_.kinds[kind].shape.sites();
    std::vector<Site> result;
    for (int column = 0; column < lattice.columns(); ++column) {
      for (int row = 0; row < lattice.rows(); ++row) {
        const Site site = {column, row};
        if (state_.outlets[outlet].region.contains(lattice::position(site)) &&
            std::all_of(sites.begin(), sites.end(),
                        [&](lattice::Axial part) { return lattice.contains(site + part); }) &&
            outlet_around(state_, {.column = column, .row = row, .kind = kind}) == outlet) {
          result.push_back(site);
        }
      }
    }
    return result;
  }

  const grains::State& state_;
  const grains::Occupancy& occupancy_;
  grains::FootprintTable footprints_;
  std::size_t outlet_;
  std::array<lattice::Direction, 3> up_;  // straight first
};

}  // namespace

bool clogged(const grains::State& state, const grains::Occupancy& occupancy, std::size_t outlet,
             lattice::Direction down) {
  check_occupancy(state, occupancy);
  static_cast<void>(state.outlets.at(outlet));
  const Search search(state, occupancy, outlet, down);
  std::vector<std::vector<Site>> places(state.kinds.size());
  for (const grains::Particle& particle : state.particles) {
    if (particle.present) {
      places[particle.kind].push_back({state.lattice.wrapped(particle.column), particle.row});
    }
  }
  std::vector<std::uint16_t> kinds(state.kinds.size());
  std::iota(kinds.begin(), kinds.end(), std::uint16_t{0});
  std::stable_sort(kinds.begin(), kinds.end(), [&](std::uint16_t one, std::uint16_t other) {
    return state.kinds[one].shape.size() > state.kinds[other].shape.size();
  });
  for (const std::uint16_t kind : kinds) {
    if (places[kind].empty()) {
      continue;
    }
    const Ways past = search.ways(kind, true);
    if (std::any_of(places[kind].begin(), places[kind].end(),
                    [&](Site site) { return past.from[state.lattice.index(site)]; })) {
      const Ways now = search.ways(kind, false);
      return now.none || now.end_at_particle || (past.reach_top && !now.reach_top);
    }
  }
  return false;
}

}  // namespace clca::measure
