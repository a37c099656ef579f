// However a straight wall is cut into several, grains move as they do along the whole one.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "property/random_contact_runs.hpp"

namespace clca::flush_walls_test {
namespace {

using contact::ContactModel;
using testing::within;

constexpr int kSteps = 160;

/// A box with a straight wall, and the same box with that wall cut into several.
struct Boxes {
  contact::State whole;
  contact::State cut;
  contact::Parameters parameters;
};

/// A beam at any angle through the box, some spacings thick.
std::vector<lattice::Site> any_beam(const lattice::Lattice& lattice) {
  const Eigen::Vector2d size = lattice.extent();
  const auto any_place = [&] {
    return Eigen::Vector2d(size.x() * within(0, 100) / 100, size.y() * within(0, 100) / 100);
  };
  const Eigen::Vector2d middle = any_place();
  const double angle = 30.0 * within(0, 6);
  const double radians = angle * std::numbers::pi / 180;
  const Eigen::Vector2d along = 200 * Eigen::Vector2d(std::cos(radians), std::sin(radians));
  return sites_along(lattice,
                     lattice::Segment{middle - along, middle + along, within(2, 8) + 0.17});
}

/// Sites by the side of straight cuts on which they lie.
std::vector<grains::Wall> pieces(const std::vector<lattice::Site>& sites) {
  struct Cut {
    Eigen::Vector2d at;
    Eigen::Vector2d across;
  };
  std::vector<Cut> cuts;
  const int count = within(1, 4);
  for (int i = 0; i < count; ++i) {
    const double radians = within(0, 360) * std::numbers::pi / 180;
    cuts.push_back({lattice::position(sites[within<std::size_t>(0, sites.size())]),
                    {std::cos(radians), std::sin(radians)}});
  }
  std::vector<grains::Wall> all(std::size_t{1} << cuts.size());
  for (const lattice::Site site : sites) {
    std::size_t piece = 0;
    for (const Cut& cut : cuts) {
      piece = 2 * piece + ((lattice::position(site) - cut.at).dot(cut.across) > 0 ? 1 : 0);
    }
    all[piece].sites.push_back(site);
  }
  std::erase_if(all, [](const grains::Wall& wall) { return wall.sites.empty(); });
  return all;
}

Boxes any_boxes() {
  const bool hexagons = within(0, 3) != 0;
  const lattice::Lattice lattice(2 * within(10, 30), within(20, 60), false);
  Boxes boxes{.whole = {.grains = {.lattice = lattice}},
              .cut = {.grains = {.lattice = lattice}},
              .parameters = testing::any_contact_parameters(hexagons)};
  contact::State& whole = boxes.whole;
  whole.grains.seed = *rc::gen::arbitrary<std::uint64_t>();
  whole.grains.kinds = testing::any_kinds(hexagons, false);
  whole.grains.walls = {{.sites = any_beam(whole.grains.lattice)}};
  RC_PRE(!whole.grains.walls.front().sites.empty());
  whole.wall_remainders.resize(1);
  ContactModel model(whole, boxes.parameters);
  model.fill({0, 0, 1e3, 1e3},
             std::vector<std::size_t>(whole.grains.kinds.size(), within<std::size_t>(1, 60)));
  whole = model.state();
  if (within(0, 2) == 0) {
    testing::stir(whole);
  }
  whole.vessel = contact::Vessel{.angle = contact::angle_from_degrees(within(-60, 61))};
  boxes.cut = whole;
  boxes.cut.grains.walls = pieces(whole.grains.walls.front().sites);
  boxes.cut.wall_remainders.resize(boxes.cut.grains.walls.size());
  return boxes;
}

void require_same(const contact::State& one, const contact::State& other) {
  RC_ASSERT(one.grains.particles == other.grains.particles);
  RC_ASSERT(one.velocities == other.velocities);
  RC_ASSERT(one.remainders == other.remainders);
}

RC_GTEST_PROP(FlushWalls, AreAsOneStraightWall, ()) {
  const Boxes boxes = any_boxes();
  ContactModel whole(boxes.whole, boxes.parameters);
  ContactModel cut(boxes.cut, boxes.parameters);
  ContactModel reference(boxes.cut, boxes.parameters, {.use_reference = true});
  for (int step = 0; step < kSteps; ++step) {
    for (ContactModel* model : {&whole, &cut, &reference}) {
      model->step();
    }
    require_same(cut.state(), whole.state());
    RC_ASSERT(reference.state() == cut.state());
  }
}

}  // namespace
}  // namespace clca::flush_walls_test
