#include "clca/scene/walls.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace clca::scene {

lattice::Lattice lattice_of(const Box& box) {
  return lattice::Lattice::covering(box.width, box.height, box.periodic);
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Rectangle& rectangle) {
  return !lattice::any_site(lattice::SweptRegion(lattice), rectangle, [](auto) { return true; });
}

bool holds_no_site(const lattice::Lattice& lattice, const lattice::Segment& segment) {
  // First without its thickness: a thick line across the box has many sites.
  const lattice::Segment thin = {segment.from, segment.to, 0};
  return lattice::sites_along(lattice, thin).empty() &&
         lattice::sites_along(lattice, segment).empty();
}

lattice::SweptRegion swept_region_of(const lattice::Lattice& lattice, const Wall& wall) {
  if (!wall.motion) {
    return lattice::SweptRegion(lattice);
  }
  const grains::OffsetRange range = grains::offset_range(*wall.motion);
  return {lattice, wall.motion->direction, range.low, range.high};
}

std::vector<lattice::Site> wall_sites(const lattice::Lattice& lattice, const Wall& wall) {
  const lattice::SweptRegion swept_region = swept_region_of(lattice, wall);
  std::vector<lattice::Site> sites;
  for (const WallPart& part : wall.parts) {
    const std::vector<lattice::Site> more = std::visit(
        [&](const auto& form) {
          if constexpr (std::is_same_v<decltype(form), const lattice::Segment&>) {
            return sites_along(swept_region, form);
          } else {
            return sites_in(swept_region, form);
          }
        },
        part);
    sites.insert(sites.end(), more.begin(), more.end());
  }
  if (wall.parts.size() > 1) {
    std::ranges::sort(sites);
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  }
  return sites;
}

bool any_swept_site(const lattice::Lattice& lattice, const Wall& wall,
                    const std::function<bool(lattice::Site)>& test) {
  const std::vector<lattice::Site> sites = wall_sites(lattice, wall);
  if (!wall.motion) {
    return std::ranges::any_of(sites, test);
  }
  const grains::OffsetRange range = grains::offset_range(*wall.motion);
  const lattice::Axial step = lattice::unit(wall.motion->direction);
  for (const lattice::Site home : sites) {
    bool entered = false;
    for (int offset = range.low; offset <= range.high; ++offset) {
      // Another site of the wall ahead of this one covers the rest from there on.
      const int ahead = offset - range.low;
      const lattice::Site site = home + lattice::Axial{offset * step.x, offset * step.q};
      const bool inside = lattice.contains(site);
      if ((entered && !inside) ||
          (ahead > 0 && std::ranges::binary_search(
                            sites, home + lattice::Axial{ahead * step.x, ahead * step.q}))) {
        break;
      }
      entered = inside;
      if (inside && test({lattice.wrapped(site.column), site.row})) {
        return true;
      }
    }
  }
  return false;
}

std::vector<bool> walls_present_at_start(const Scene& scene) {
  std::vector<bool> there(scene.walls.size(), true);
  // Backwards, so that the first stage that names a wall decides; of one stage, insert.
  for (std::size_t i = scene.stages.size(); i > 0; --i) {
    for (const std::size_t wall : scene.stages[i - 1].removed_walls) {
      there[wall] = true;
    }
    for (const std::size_t wall : scene.stages[i - 1].inserted_walls) {
      there[wall] = false;
    }
  }
  return there;
}

std::vector<std::vector<bool>> walls_present_by_stage(const Scene& scene) {
  std::vector<bool> there = walls_present_at_start(scene);
  std::vector<std::vector<bool>> all;
  for (const Stage& stage : scene.stages) {
    for (const std::size_t wall : stage.removed_walls) {
      there[wall] = false;
    }
    for (const std::size_t wall : stage.inserted_walls) {
      there[wall] = true;
    }
    all.push_back(there);
  }
  return all;
}

}  // namespace clca::scene
