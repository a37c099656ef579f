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

[[noreturn]] void fail(const Wall& wall, const std::string& message) {
  throw SceneError(fmt::format("{}: error: walls.{}: {}", wall.location, wall.name, message));
}

/// A rectangle around all sites that the wall ever covers, without wrapping.
lattice::Rectangle around(const Wall& wall) {
  const auto around_part = [](const WallPart& part) {
    return std::visit([](const auto& form) { return around(form); }, part);
  };
  lattice::Rectangle all = around_part(wall.parts.front());
  for (const WallPart& part : wall.parts) {
    const lattice::Rectangle rectangle = around_part(part);
    all = {std::min(all.left, rectangle.left), std::min(all.bottom, rectangle.bottom),
           std::max(all.right, rectangle.right), std::max(all.top, rectangle.top)};
  }
  if (!wall.motion) {
    return all;
  }
  const grains::OffsetRange range = grains::range_of(*wall.motion);
  const Eigen::Vector2d step = lattice::position(lattice::unit(wall.motion->direction));
  const auto [left, right] = std::minmax({step.x() * range.low, step.x() * range.high});
  const auto [down, up] = std::minmax({step.y() * range.low, step.y() * range.high});
  return {all.left + left - 1, all.bottom + down - 1, all.right + right + 1, all.top + up + 1};
}

/// Quick test before comparing sites.
bool far_apart(const lattice::Lattice& lattice, const Wall& a, const Wall& b) {
  const lattice::Rectangle one = around(a);
  const lattice::Rectangle other = around(b);
  const bool apart = one.top < other.bottom || other.top < one.bottom;
  return apart || (!lattice.periodic() && (one.right < other.left || other.right < one.left));
}

/// True if both walls share an initial site for which `counts` is true.
template <class Counts>
bool share_home(const lattice::Lattice& lattice, const Wall& a, const Wall& b, Counts counts) {
  const std::vector<lattice::Site> sites = wall_sites(lattice, a);
  const std::vector<lattice::Site> others = wall_sites(lattice, b);
  return std::any_of(sites.begin(), sites.end(), [&](lattice::Site site) {
    return counts(site) && std::binary_search(others.begin(), others.end(), site);
  });
}

/// Checks the initial positions.
void check_begin(const lattice::Lattice& lattice, const Wall& mover, const Wall& other) {
  const auto in_box = [&](lattice::Site site) { return lattice.contains(site); };
  if (!far_apart(lattice, mover, other) && share_home(lattice, mover, other, in_box)) {
    fail(mover, fmt::format("stands in wall '{}' at the start; insert one of them later, or move "
                            "one of them elsewhere",
                            other.name));
  }
}

/// The walls present in some stage that moves `mover`.
std::vector<bool> companions(const Scene& scene, const std::vector<std::vector<bool>>& there,
                             std::size_t mover) {
  std::vector<bool> result(scene.walls.size(), false);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const std::vector<std::size_t>& moved = scene.stages[i].move;
    if (std::find(moved.begin(), moved.end(), mover) != moved.end()) {
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
  if (far_apart(lattice, mover, other)) {
    return;
  }
  if (other.motion == mover.motion) {
    if (share_home(lattice, mover, other, [](lattice::Site) { return true; })) {
      fail(mover,
           fmt::format("shares sites with wall '{}', which has the same motion; make them parts "
                       "of one wall, or move one of them elsewhere",
                       other.name));
    }
    return;
  }
  if (any_swept_site(lattice, other,
                     [&](lattice::Site site) { return way[lattice.index(site)]; })) {
    fail(mover, fmt::format("its way meets {} wall '{}'; {}, or move one of them elsewhere",
                            other.motion ? "that of" : "the standing", other.name,
                            other.motion ? "shorten a distance or amplitude"
                                         : "shorten the distance or amplitude"));
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
      fail(mover, fmt::format("no site of the box, {} wide and {} high, lies on its way",
                              scene.box.width, scene.box.height));
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
