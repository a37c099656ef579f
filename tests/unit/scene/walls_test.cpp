#include "clca/scene/walls.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::walls_test {

namespace {

using lattice::Site;
using ::testing::ElementsAre;

Scene scene_with(std::string_view part) {
  return parse(testing::scene_with(part), "scene.yaml");
}

std::string refusal(const Scene& scene) {
  try {
    check_walls(scene);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

/// The sites of the box that are covered after some step, all tried one by one.
std::set<Site> plain_way(const lattice::Lattice& lattice, const Wall& wall) {
  const grains::OffsetRange range = grains::offset_range(*wall.motion);
  const lattice::Axial step = lattice::unit(wall.motion->direction);
  std::set<Site> way;
  for (const Site home : wall_sites(lattice, wall)) {
    for (int i = range.low; i <= range.high; ++i) {
      const Site site = home + lattice::Axial{i * step.x, i * step.q};
      if (lattice.contains(site)) {
        way.insert({lattice.wrapped(site.column), site.row});
      }
    }
  }
  return way;
}

std::set<Site> way_of(const lattice::Lattice& lattice, const Wall& wall) {
  std::set<Site> way;
  any_swept_site(lattice, wall, [&](Site site) {
    way.insert(site);
    return false;
  });
  return way;
}

/// A plate and another wall of the same motion or of none.
std::string two(const std::string& plate, const std::string& other) {
  return "walls: {plate: {" + plate + "}, other: {" + other + "}}\n";
}

constexpr const char* kDown = "motion: {direction: down, distance: 10}";
constexpr const char* kNoOutput = "output: {}\n";
constexpr const char* kOne = "stages: [{name: first, sources: [spout], move: [plate]}]";
constexpr const char* kBoth = "stages: [{name: first, sources: [spout], move: [plate, other]}]";

}  // namespace

TEST(WallSites, AreThoseOfAllPartsOnce) {
  const Scene scene =
      scene_with("walls: {tray: {parts: [{box: [0, 0, 1, 3]}, {box: [0, 1, 1, 5]}]}}");
  EXPECT_THAT(wall_sites(lattice::Lattice(116, 50, false), scene.walls[0]),
              ElementsAre(Site{0, 0}, Site{0, 1}, Site{0, 2}, Site{0, 3}, Site{0, 4}, Site{1, 0},
                          Site{1, 1}, Site{1, 2}, Site{1, 3}, Site{1, 4}));
}

TEST(WallSites, OfAWallThatMovesMayBeginOutsideTheBox) {
  const Wall above = {.name = "plate",
                      .parts = {lattice::Rectangle{0, 60, 0.5, 1e6}},
                      .motion = grains::WallMotion{lattice::Direction::down, grains::Drive{1, 15}}};
  const lattice::Lattice lattice(116, 50, false);
  EXPECT_THAT(wall_sites(lattice, above),
              ElementsAre(Site{0, 60}, Site{0, 61}, Site{0, 62}, Site{0, 63}, Site{0, 64}));
}

TEST(WallsThere, FollowsWhatStagesInsertAndRemove) {
  const Scene scene = scene_with(
      "stages:\n"
      "  - {name: first, sources: [spout]}\n"
      "  - {name: second, insert: [left], remove: [right]}\n"
      "  - {name: third, remove: [left], insert: [right]}\n");
  EXPECT_THAT(walls_present_at_start(scene), ElementsAre(false, true));
  EXPECT_THAT(
      walls_present_by_stage(scene),
      ElementsAre(ElementsAre(false, true), ElementsAre(true, false), ElementsAre(false, true)));
}

TEST(Way, IsEverySiteThatTheWallCoversSomewhere) {
  const std::vector<WallPart> forms = {lattice::Rectangle{-5, -5, 4, 30},
                                       lattice::Rectangle{3, 2, 5, 4},
                                       lattice::Segment{{-10, 3}, {20, 9}, 1},
                                       lattice::Segment{{4, -20}, {4, 40}, 3},
                                       Disc{{-3, 5}, 6},
                                       Ring{{5, 12}, 4, 2},
                                       Arc{{{5, 3}, 5, 1}, 20, 250}};
  for (const bool periodic : {false, true}) {
    const lattice::Lattice lattice(12, 9, periodic);
    for (const lattice::Direction direction : lattice::kDirections) {
      for (const std::int32_t amplitude : {1, 3, 20}) {
        const grains::Wave wave = {grains::Waveform::sine, amplitude, 200};
        const grains::Drive drive = {1, amplitude};
        for (const WallPart& form : forms) {
          Wall wall = {.name = "plate", .parts = {form, lattice::Rectangle{0, 0, 1, 2}}};
          wall.motion = grains::WallMotion{direction, wave};
          EXPECT_EQ(way_of(lattice, wall), plain_way(lattice, wall));
          wall.motion->program = drive;
          EXPECT_EQ(way_of(lattice, wall), plain_way(lattice, wall));
        }
      }
    }
  }
}

TEST(Way, EndsWhereTheTestHolds) {
  const Wall wall = {.name = "plate", .parts = {lattice::Rectangle{0, 0, 9, 9}}};
  int visited = 0;
  EXPECT_TRUE(
      any_swept_site(lattice::Lattice(12, 9, false), wall, [&](Site) { return ++visited == 5; }));
  EXPECT_EQ(visited, 5);
}

TEST(CheckWalls, TakesAWayThatEndsAtAWallButNotOneSiteFurther) {
  const std::string floor = "box: [0, 0, 100, 12]";
  const auto down = [&](int distance) {
    return two("box: [10, 40, 20, 42], motion: {direction: down, distance: " +
                   std::to_string(distance) + "}",
               floor) +
           kOne;
  };
  EXPECT_EQ(refusal(scene_with(down(28))), "accepted");
  EXPECT_NE(refusal(scene_with(down(29))), "accepted");
}

TEST(CheckWalls, TakesWallsThatAreNotThereWhileTheOtherMoves) {
  const std::string walls =
      two("box: [10, 40, 20, 42], motion: {direction: down, distance: 40}", "box: [0, 0, 100, 12]");
  EXPECT_EQ(refusal(scene_with(walls + "stages:\n"
                                       "  - {name: first, sources: [spout]}\n"
                                       "  - {name: second, remove: [other], move: [plate]}\n"
                                       "  - {name: third, insert: [other]}\n")),
            "accepted");
}

TEST(CheckWalls, TakesTwoThatMoveAlikeSideBySide) {
  const std::string left = std::string("box: [10, 40, 20, 42], ") + kDown;
  EXPECT_EQ(refusal(scene_with(two(left, std::string("box: [10, 35, 20, 40], ") + kDown) + kBoth)),
            "accepted");
  EXPECT_EQ(refusal(scene_with(two(left,
                                   "box: [10, 35, 20, 40], motion: {direction: down, "
                                   "distance: 11}") +
                               kBoth)),
            "scene.yaml:7:16: error: walls.plate: its way meets that of wall 'other'; shorten a "
            "distance or amplitude, or move one of them elsewhere");
}

TEST(CheckWalls, LooksAcrossTheSeamOfAPeriodicBoxOnly) {
  const std::string walls =
      two("box: [95, 20, 100, 22], motion: {direction: up_right, distance: 15}",
          "box: [6, 20, 8, 40]") +
      kOne;
  EXPECT_EQ(refusal(scene_with(walls)), "accepted");
  EXPECT_NE(refusal(scene_with("box: {width: 100, height: 50, periodic: true}\n" + walls)),
            "accepted");
}

TEST(CheckWalls, TakesLittleForAPlateThatIsVeryHigh) {
  const Scene scene = scene_with(
      two("box: [10, 40, 20, 1e6], motion: {direction: down, distance: 20}",
          "line: {from: [60, 40], to: [60, 1e6]}, motion: {direction: down, distance: 20}") +
      kNoOutput + kBoth);
  EXPECT_EQ(refusal(scene), "accepted");
  EXPECT_LT(model_size(scene).memory_bytes, 3e5);
}

TEST(SizeOf, CountsAllPartsTheWayOutsideAndSecondOwners) {
  const auto bytes = [](const std::string& wall) {
    return model_size(scene_with("walls: {plate: {" + wall + "}}\n" + kNoOutput + kOne))
        .memory_bytes;
  };
  const double least = bytes(std::string("box: [0, 49, 100, 50], ") + kDown);
  EXPECT_GE(bytes(std::string("box: [0, 49, 100, 1e6], ") + kDown), least + 8.0 * 116 * 9);
  EXPECT_GE(
      bytes(std::string("parts: [{box: [0, 49, 100, 50]}, {box: [0, 45, 100, 48]}], ") + kDown),
      least + 8.0 * 116 * 3);
  EXPECT_GE(bytes(std::string("box: [0, 49, 100, 50], passive: overlap, ") + kDown),
            least + 4.0 * 116 * 50);
}

TEST(SizeOf, IsNeverBelowTheSitesOfAWallThatMoves) {
  const lattice::Lattice lattice(116, 50, false);
  const double still =
      model_size(scene_with("walls: {}\nstages: [{name: first, sources: [spout]}]")).memory_bytes;
  for (const std::string direction :
       {"up", "up_right", "down_right", "down", "down_left", "up_left"}) {
    for (const std::string form :
         {"box: [-1000, -1000, 1000, 1000]",
          "line: {from: [-300, -200], to: [300, 260], thickness: 9}", "box: [-30, 40, 20, 70]",
          "disc: {centre: [30, 20], radius: 12}", "disc: {centre: [90, 20], radius: 500}",
          "ring: {centre: [30, 20], radius: 15}",
          "arc: {centre: [30, 20], radius: 200, thickness: 20, from: -150, to: 200}"}) {
      const Scene scene = scene_with(
          fmt::format("walls: {{plate: {{{}, motion: {{direction: {}, distance: 300}}}}}}\n{}",
                      form, direction, kOne));
      EXPECT_GE(model_size(scene).memory_bytes - still,
                8.0 * static_cast<double>(wall_sites(lattice, scene.walls[0]).size()))
          << form << ' ' << direction;
    }
  }
}

}  // namespace clca::scene::walls_test
