// Rejects fills that cannot fit and outlets that no particle fits into.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "scene/geometry.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Whether `found` returns true for a site in the rectangle; from below, from the left.
template <class Found>
bool any_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle, Found found) {
  const auto bounded = [](double value, int end) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, static_cast<double>(end)));
  };
  const int last_column = bounded(rectangle.right / lattice::kColumnPitch + 2, lattice.columns());
  const int last_row = bounded(rectangle.top + 2, lattice.rows());
  for (int column = bounded(rectangle.left / lattice::kColumnPitch - 1, lattice.columns());
       column < last_column; ++column) {
    for (int row = bounded(rectangle.bottom - 1, lattice.rows()); row < last_row; ++row) {
      const lattice::Site site = {column, row};
      if (rectangle.contains(lattice::position(site)) && found(site)) {
        return true;
      }
    }
  }
  return false;
}

/// Whether the species fits into the rectangle in one of its orientations on `free` sites.
template <class Free>
bool finds_room(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle,
                const Species& species, Free free) {
  return std::ranges::any_of(species.orientations, [&](int degrees) {
    const lattice::Shape shape = species.shape.rotated(degrees / kDegreesPerSixth);
    const lattice::Axial first = shape.sites().front();
    return any_site(lattice, rectangle, [&](lattice::Site at) {
      return std::ranges::all_of(shape.sites(), [&](lattice::Axial part) {
        lattice::Site site = at + (part - first);
        site.column = lattice.wrapped(site.column);
        return lattice.contains(site) && rectangle.contains(lattice::position(site)) && free(site);
      });
    });
  });
}

/// One bit per site index: a lower bound of what walls cover at the start of a stage. Walls moved
/// by an earlier stage may be anywhere.
std::vector<bool> covered_at_begin(const Scene& scene, const lattice::Lattice& lattice,
                                   std::size_t stage, const std::vector<bool>& there) {
  std::vector<bool> covered(lattice.index_count(), false);
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    const bool moved =
        std::any_of(scene.stages.begin(), scene.stages.begin() + static_cast<std::ptrdiff_t>(stage),
                    [wall](const Stage& earlier) {
                      return std::ranges::find(earlier.move, wall) != earlier.move.end();
                    });
    if (!there[wall] || moved) {
      continue;
    }
    for (const lattice::Site site : wall_sites(lattice, scene.walls[wall])) {
      if (lattice.contains(site)) {
        covered[lattice.index(site)] = true;
      }
    }
  }
  return covered;
}

void check_fill(const Scene& scene, const lattice::Lattice& lattice, const Stage& stage,
                const std::vector<bool>& covered) {
  const Fill& fill = *stage.fill;
  const auto free = [&](lattice::Site site) { return !covered[lattice.index(site)]; };
  double wanted = 0;
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const Species& species = scene.species[i];
    if (!fill.counts.empty()) {
      wanted += static_cast<double>(fill.counts[i]) * static_cast<double>(species.shape.size());
    }
    if (has_species(fill, i) && !finds_room(lattice, fill.region, species, free)) {
      throw_error(fill.location,
                  fmt::format("stages.{}.fill: no {} fits into the region; enlarge it", stage.name,
                              species.name));
    }
  }
  double sites = 0;
  any_site(lattice, fill.region, [&](lattice::Site site) {
    sites += free(site) ? 1 : 0;
    return false;
  });
  if (wanted > sites) {
    throw_error(
        fill.location,
        fmt::format("stages.{}.fill: the counts take {:.0f} sites and the region has {:.0f} that "
                    "no wall covers; enlarge the region, lower the counts or fill in several "
                    "stages",
                    stage.name, wanted, sites));
  }
}

}  // namespace

void check_room(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  for (const Outlet& outlet : scene.outlets) {
    const bool any = std::ranges::any_of(scene.species, [&](const Species& species) {
      return finds_room(lattice, outlet.region, species, [](lattice::Site) { return true; });
    });
    if (!any) {
      throw_error(
          outlet.location,
          fmt::format("outlets.{}: no particle fits into the region, and only those that lie "
                      "wholly inside are removed; enlarge it",
                      outlet.name));
    }
  }
  const std::vector<std::vector<bool>> there = walls_present_by_stage(scene);
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    if (scene.stages[stage].fill) {
      check_fill(scene, lattice, scene.stages[stage],
                 covered_at_begin(scene, lattice, stage, there[stage]));
    }
  }
}

}  // namespace clca::scene
