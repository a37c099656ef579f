// Rejects moving walls that never enter the box or meet another wall.

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "scene/geometry.hpp"
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

/// Checks the initial positions.
void check_begin(const lattice::Lattice& lattice, const Wall& mover, const Wall& other) {
  const auto in_box = [&](lattice::Site site) { return lattice.contains(site); };
  if (share_initial_site(lattice, mover, other, in_box)) {
    fail(mover,
         "stands in wall '{}' at the start; insert one of them later, or move "
         "one of them elsewhere",
         other.name);
  }
}

/// The walls present in some stage that moves `mover`.
std::vector<bool> companions(const Scene& scene, const std::vector<std::vector<bool>>& there,
                             std::size_t mover) {
  std::vector<bool> result(scene.walls.size(), false);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const std::vector<std::size_t>& moved = scene.stages[i].move;
    if (std::ranges::find(moved, mover) != moved.end()) {
      std::transform(result.begin(), result.end(), there[i].begin(), result.begin(),
                     std::logical_or<>());
    }
  }
  result[mover] = false;
  return result;
}

/// One bit per site index.
std::vector<bool> way_of(const lattice::Lattice& lattice, const Wall& wall) {
  std::vector<bool> way(lattice.index_count(), false);
  bool empty = true;
  any_swept_site(lattice, wall, [&](lattice::Site site) {
    way[lattice.index(site)] = true;
    empty = false;
    return false;
  });
  return empty ? std::vector<bool>() : way;
}

void check_pair(const lattice::Lattice& lattice, const Wall& mover, const std::vector<bool>& way,
                const Wall& other) {
  if (other.motion == mover.motion) {
    if (share_initial_site(lattice, mover, other, [](lattice::Site) { return true; })) {
      fail(mover,
           "shares sites with wall '{}', which has the same motion; make them "
           "parts of one wall, "
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

}  // namespace

void check_walls(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  const std::vector<std::vector<bool>> there = walls_present_by_stage(scene);
  const std::vector<bool> first = walls_present_at_start(scene);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& mover = scene.walls[i];
    if (!mover.motion) {
      continue;
    }
    const std::vector<bool> way = way_of(lattice, mover);
    if (way.empty()) {
      fail(mover, "no site of the box, {} wide and {} high, lies on its way", scene.box.width,
           scene.box.height);
    }
    const std::vector<bool> met = companions(scene, there, i);
    for (std::size_t other = 0; other < scene.walls.size(); ++other) {
      if (met[other]) {
        check_pair(lattice, mover, way, scene.walls[other]);
      } else if (other != i && first[i] && first[other]) {
        check_begin(lattice, mover, scene.walls[other]);
      }
    }
  }
}

}  // namespace clca::scene
