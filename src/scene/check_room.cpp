// Rejects moving walls that never enter the box or meet another wall, fills that cannot fit,
// outlets that no particle fits into, and sources of particles that fit nowhere.

#include <algorithm>
#include <cmath>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

template <class... Args>
[[noreturn]] void fail(const Wall& wall, fmt::format_string<Args...> message, Args&&... args) {
  throw_error(wall.location, fmt::format("walls.{}: {}", wall.name,
                                         fmt::format(message, std::forward<Args>(args)...)));
}

/// True if both walls share an initial site for which `counts` is true.
template <class Counts>
bool share_initial_site(const lattice::Lattice& lattice, const Wall& a, const Wall& b,
                        Counts counts) {
  const std::vector<lattice::Site> sites = wall_sites(lattice, a);
  const std::vector<lattice::Site> others = wall_sites(lattice, b);
  return std::ranges::any_of(sites, [&](lattice::Site site) {
    return counts(site) && std::binary_search(others.begin(), others.end(), site);
  });
}

/// The walls present in some stage that moves `mover`.
std::vector<bool> walls_present_with(const Scene& scene,
                                     const std::vector<std::vector<bool>>& there,
                                     std::size_t mover) {
  std::vector<bool> result(scene.walls.size(), false);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    if (std::ranges::count(scene.stages[i].moving_walls, mover) > 0) {
      std::transform(result.begin(), result.end(), there[i].begin(), result.begin(),
                     std::logical_or<>());
    }
  }
  result[mover] = false;
  return result;
}

/// One bit per site index.
std::vector<bool> swept_sites(const lattice::Lattice& lattice, const Wall& wall) {
  std::vector<bool> way(lattice.index_count(), false);
  any_swept_site(lattice, wall, [&](lattice::Site site) {
    way[lattice.index(site)] = true;
    return false;
  });
  return way;
}

void check_pair(const lattice::Lattice& lattice, const Wall& mover, const std::vector<bool>& way,
                const Wall& other) {
  if (other.motion == mover.motion) {
    if (share_initial_site(lattice, mover, other, [](lattice::Site) { return true; })) {
      fail(mover,
           "shares sites with wall '{}', which has the same motion; make them parts of one wall, "
           "or move one of them elsewhere",
           other.name);
    }
    return;
  }
  if (any_swept_site(lattice, other,
                     [&](lattice::Site site) { return way[lattice.index(site)]; })) {
    fail(mover, "its way meets {} wall '{}'; {}, or move one of them elsewhere",
         other.motion ? "that of" : "the standing", other.name,
         other.motion ? "shorten a distance or amplitude" : "shorten the distance or amplitude");
  }
}

/// Whether a shape lies on `free` sites of the box with its site `reference` at `at`.
template <class Free>
bool lies_free(const lattice::Lattice& lattice, const lattice::Shape& shape,
               lattice::Axial reference, lattice::Site at, Free free) {
  return std::ranges::all_of(shape.sites(), [&](lattice::Axial part) {
    lattice::Site site = at + (part - reference);
    site.column = lattice.wrapped(site.column);
    return lattice.contains(site) && free(site);
  });
}

/// Whether the species fits into the rectangle in one of its orientations on `free` sites.
template <class Free>
bool finds_room(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle,
                const Species& species, Free free) {
  const lattice::SweptRegion box(lattice);
  return std::ranges::any_of(species.orientations, [&](int degrees) {
    const lattice::Shape shape = species.shape.rotated(degrees / kOrientationStep);
    return any_site(box, rectangle, [&](lattice::Site at) {
      return lies_free(lattice, shape, shape.sites().front(), at, [&](lattice::Site site) {
        return rectangle.contains(lattice::position(site)) && free(site);
      });
    });
  });
}

/// By site index: whether walls surely cover it in a stage. Walls that have moved may be anywhere.
std::vector<bool> covered_in(const Scene& scene, const lattice::Lattice& lattice,
                             std::size_t moving_stages, const std::vector<bool>& there) {
  std::vector<bool> covered(lattice.index_count(), false);
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    const bool moved = std::any_of(
        scene.stages.begin(), scene.stages.begin() + static_cast<std::ptrdiff_t>(moving_stages),
        [wall](const Stage& earlier) {
          return std::ranges::count(earlier.moving_walls, wall) > 0;
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
    if (!fill.species_counts.empty()) {
      wanted +=
          static_cast<double>(fill.species_counts[i]) * static_cast<double>(species.shape.size());
    }
    if (places_species(fill, i) && !finds_room(lattice, fill.region, species, free)) {
      throw_error(fill.location,
                  fmt::format("stages.{}.fill: no {} fits into the region; enlarge it", stage.name,
                              species.name));
    }
  }
  double sites = 0;
  any_site(lattice::SweptRegion(lattice), fill.region, [&](lattice::Site site) {
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

/// The sites that walls cover throughout the stages for which `counts` is true.
template <class Counts>
std::vector<bool> always_covered(const Scene& scene, const lattice::Lattice& lattice,
                                 Counts counts) {
  std::vector<bool> always(lattice.index_count(), true);
  const std::vector<std::vector<bool>> there = walls_present_by_stage(scene);
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    if (counts(scene.stages[stage])) {
      const std::vector<bool> covered = covered_in(scene, lattice, stage + 1, there[stage]);
      std::transform(always.begin(), always.end(), covered.begin(), always.begin(),
                     std::logical_and<>());
    }
  }
  return always;
}

void check_outlets(const Scene& scene, const lattice::Lattice& lattice) {
  if (scene.outlets.empty()) {
    return;
  }
  const std::vector<bool> covered =
      always_covered(scene, lattice, [](const Stage& /*stage*/) { return true; });
  for (const Outlet& outlet : scene.outlets) {
    const bool any = std::ranges::any_of(scene.species, [&](const Species& species) {
      return finds_room(lattice, outlet.region, species,
                        [&](lattice::Site site) { return !covered[lattice.index(site)]; });
    });
    if (!any) {
      throw_error(
          outlet.location,
          fmt::format("outlets.{}: no particle fits into the region, and only those that lie "
                      "wholly inside are removed; enlarge it, or move it out of walls",
                      outlet.name));
    }
  }
}

/// A source keeps what it has drawn until that fits, so each orientation has to fit somewhere.
void check_source(const Scene& scene, const lattice::Lattice& lattice, std::size_t number) {
  const Source& source = scene.sources[number];
  const std::vector<bool> covered = always_covered(scene, lattice, [&](const Stage& stage) {
    return std::ranges::count(stage.open_sources, number) > 0;
  });
  const std::vector<lattice::Site> sites = source_sites(lattice, source);
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const Species& species = scene.species[i];
    for (const int degrees :
         source.species_weights[i] > 0 ? species.orientations : std::vector<int>()) {
      const lattice::Shape shape =
          lattice::centred(species.shape.rotated(degrees / kOrientationStep));
      const bool fits = std::ranges::any_of(sites, [&](lattice::Site at) {
        return lies_free(lattice, shape, {0, 0}, at,
                         [&](lattice::Site site) { return !covered[lattice.index(site)]; });
      });
      if (!fits) {
        throw_error(
            source.location,
            fmt::format(
                "sources.{}: no {} ever fits there{}; move it away from walls and "
                "the sides of the box",
                source.name, species.name,
                species.orientations.size() > 1 ? fmt::format(" at {} degrees", degrees) : ""));
      }
    }
  }
}

}  // namespace

std::vector<lattice::Site> source_sites(const lattice::Lattice& lattice, const Source& source) {
  if (const auto* point = std::get_if<Eigen::Vector2d>(&source.position)) {
    return {lattice::nearest_site(*point)};
  }
  return lattice::sites_in(lattice, std::get<lattice::Rectangle>(source.position));
}

void check_walls(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  const std::vector<std::vector<bool>> there = walls_present_by_stage(scene);
  const std::vector<bool> first = walls_present_at_start(scene);
  const auto in_box = [&](lattice::Site site) { return lattice.contains(site); };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& mover = scene.walls[i];
    if (!mover.motion) {
      continue;
    }
    const std::vector<bool> way = swept_sites(lattice, mover);
    if (std::ranges::find(way, true) == way.end()) {
      fail(mover, "no site of the box, {} wide and {} high, lies on its way", scene.box.width,
           scene.box.height);
    }
    const std::vector<bool> met = walls_present_with(scene, there, i);
    for (std::size_t other = 0; other < scene.walls.size(); ++other) {
      if (met[other]) {
        check_pair(lattice, mover, way, scene.walls[other]);
      } else if (other != i && first[i] && first[other] &&
                 share_initial_site(lattice, mover, scene.walls[other], in_box)) {
        fail(mover,
             "stands in wall '{}' at the start; insert one of them later, or move one of them "
             "elsewhere",
             scene.walls[other].name);
      }
    }
  }
}

void check_room(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  check_outlets(scene, lattice);
  for (std::size_t source = 0; source < scene.sources.size(); ++source) {
    check_source(scene, lattice, source);
  }
  const std::vector<std::vector<bool>> there = walls_present_by_stage(scene);
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    if (scene.stages[stage].fill) {
      check_fill(scene, lattice, scene.stages[stage],
                 covered_in(scene, lattice, stage, there[stage]));
    }
  }
}

}  // namespace clca::scene
