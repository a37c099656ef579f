// Fills that find no room, and outlets that nothing fits into, are refused before anything runs.

#include <gtest/gtest.h>

#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"

namespace clca::scene::room_test {
namespace {

/// `changes`: lines that come after the species.
std::string refusal(const std::string& lines, bool periodic = false) {
  const std::string box =
      periodic ? "{width: 60, height: 60, periodic: true}" : "{width: 60, height: 60}";
  const Scene scene = parse("clca: 1\nbox: " + box +
                                "\nspecies: {grain: {shape: {hexagon: 1}}, "
                                "rod: {shape: {rod: {radius: 0, length: 20}}, "
                                "orientations: [0, 60]}}\n" +
                                lines,
                            "room.yaml");
  try {
    check_room(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

std::string filled(const std::string& fill, const std::string& more = "") {
  return more + "stages: [{name: rain, fill: {" + fill +
         "}, until: {steps: 1}}, {name: rods, fill: {region: [0, 0, 60, 60], counts: {grain: 1, "
         "rod: "
         "1}}, until: {steps: 1}}]\n";
}

TEST(AFill, ThatTakesMoreSitesThanItsRegionHasIsRefusedWithBothNumbers) {
  EXPECT_EQ(refusal(filled("region: [0, 0, 60, 60], counts: {grain: 10000}")),
            "room.yaml:4:29: error: stages.rain.fill: the counts take 70000 sites and the region "
            "has 4200 that no wall covers; enlarge the region, lower the counts or fill in several "
            "stages");
  EXPECT_EQ(refusal(filled("region: [0, 0, 60, 60], counts: {grain: 600}")), "");
  EXPECT_NE(refusal(filled("region: [0, 0, 60, 60], counts: {grain: 601}")), "");
}

TEST(AFill, HasTheSitesOfWallsThatThisStageOrOneBeforeRemoves) {
  const std::string fill = "region: [0, 0, 60, 60], counts: {grain: 500}";
  const std::string wall = "walls: {slab: {box: [0, 0, 60, 40]}}\n";
  const std::string stays = refusal(filled(fill, wall));
  EXPECT_NE(stays.find("has 1400 that no wall covers"), std::string::npos) << stays;
  EXPECT_EQ(refusal(wall + "stages: [{name: rain, remove: [slab], fill: {" + fill +
                    "}, until: {steps: 1}}, {name: rods, fill: {region: [0, 0, 60, 60], counts: "
                    "{rod: 1}}}]\n"),
            "");
}

TEST(AFill, IsNotRefusedForAWallThatMayHaveMovedAway) {
  const std::string wall =
      "walls: {slab: {box: [0, 0, 60, 40], motion: {direction: down, distance: 40}}}\n";
  const std::string fill = "fill: {region: [0, 0, 60, 60], counts: {grain: 500, rod: 1}}";
  EXPECT_EQ(refusal(wall + "stages: [{name: down, move: [slab], until: settled}, {name: rain, " +
                    fill + "}]\n"),
            "");
  EXPECT_NE(refusal(wall + "stages: [{name: rain, " + fill +
                    "}, {name: down, move: [slab], until: settled}]\n"),
            "");
}

TEST(AFill, OfAShapeThatFitsNowhereIsRefused) {
  const std::string thin = refusal(filled("region: [0, 0, 60, 9], counts: {grain: 1, rod: 1}"));
  EXPECT_NE(thin.find("stages.rain.fill: no rod fits into the region"), std::string::npos) << thin;
  EXPECT_EQ(refusal(filled("region: [0, 0, 60, 11], counts: {rod: 1}")), "")
      << "in one of its orientations";
}

TEST(AFill, FindsRoomAcrossThePeriodicSeam) {
  const std::string wall = "walls: {post: {box: [8, 0, 52, 60]}}\n";
  const std::string fill = "region: [0, 0, 61, 60], counts: {rod: 1}";
  const std::string flat = "stages: [{name: rain, fill: {" + fill +
                           "}}, "
                           "{name: grains, remove: [post], fill: {region: [0, 0, 60, 60], counts: "
                           "{grain: 1}}}]\n";
  const std::string only_flat = wall + flat;
  EXPECT_EQ(refusal(only_flat, true), "");
}

TEST(AnOutlet, ThatNoParticleFitsIntoIsRefusedWithItsPlace) {
  const std::string fill = filled("region: [0, 0, 60, 60], counts: {grain: 1}");
  EXPECT_EQ(
      refusal("outlets: {drain: {region: [0, 0, 60, 1]}}\n" + fill),
      "room.yaml:4:27: error: outlets.drain: no particle fits into the region, and only those "
      "that lie wholly inside are removed; enlarge it, or move it out of walls");
  EXPECT_EQ(refusal("outlets: {drain: {region: [0, 0, 60, 3.5]}}\n" + fill), "");
  EXPECT_EQ(refusal("outlets: {drain: {region: [0, 0, 0.5, 25]}}\n" + fill), "")
      << "rods fit that stand upright";
}

TEST(AnOutlet, InAWallThatStaysIsRefused) {
  const std::string drain =
      "outlets: {drain: {region: [0, 0, 60, 9]}}\nwalls: {slab: {box: [0, 0, 60, 10]}}\n";
  EXPECT_NE(refusal(drain + filled("region: [0, 20, 60, 60], counts: {grain: 1}"))
                .find("outlets.drain: no particle fits into the region"),
            std::string::npos);
  EXPECT_EQ(refusal(drain + "stages: [{name: rain, fill: {region: [0, 20, 60, 60], counts: {grain: "
                            "1, rod: 1}}}, {name: flow, remove: [slab]}]\n"),
            "");
}

/// The scene with a source that is open in the second of two stages.
std::string emitted(const std::string& source, const std::string& more = "",
                    const std::string& second = "") {
  return more + "sources: {spout: {" + source +
         ", rate: 1}}\nstages: [{name: rain, fill: {region: [0, 0, 60, 60], counts: {grain: 1, "
         "rod: 1}}}, {name: flow, sources: [spout], until: {steps: 9}" +
         second + "}]\n";
}

TEST(ASource, OfWhatNeverFitsIsRefused) {
  EXPECT_EQ(refusal(emitted("at: [30, 58], species: {grain: 1, rod: 1}")),
            "room.yaml:4:18: error: sources.spout: no rod ever fits there at 0 degrees; move it "
            "away from walls and the sides of the box");
  EXPECT_EQ(refusal(emitted("at: [30, 58], species: {grain: 1}")), "");
  EXPECT_EQ(refusal(emitted("region: [0, 0, 60, 60]")), "");
  EXPECT_NE(refusal(emitted("at: [30, 59.5], species: {grain: 1}")), "");
}

TEST(ASource, HasRoomWhereAWallHasGoneOrMoves) {
  const std::string spout = "at: [30, 30], species: {grain: 1}";
  const std::string slab = "walls: {slab: {box: [0, 25, 60, 35]}}\n";
  EXPECT_NE(refusal(emitted(spout, slab)).find("no grain ever fits there; move it"),
            std::string::npos);
  EXPECT_EQ(refusal(emitted(spout, slab, ", remove: [slab]")), "");
  const std::string lift =
      "walls: {slab: {box: [0, 25, 60, 35], motion: {direction: up, distance: 20}}}\n";
  EXPECT_EQ(refusal(emitted(spout, lift, ", move: [slab]")), "");
}

TEST(AWallThatMoves, StandsInNoOtherAtTheStart) {
  const auto begun = [](const std::string& plate) {
    const Scene scene = parse(
        "clca: 1\nbox: {width: 60, height: 60}\n"
        "species: {grain: {shape: {hexagon: 1}}}\n"
        "walls: {post: {box: [0, 0, 60, 10]}, plate: {box: " +
            plate +
            ", motion: {direction: up, distance: 5}}}\n"
            "stages: [{name: rain, fill: {region: [0, 30, 60, 60], counts: "
            "{grain: 1}}}, {name: lift, remove: [post], move: [plate]}]\n",
        "room.yaml");
    check_walls(scene);
  };
  EXPECT_NO_THROW(begun("[10, 11, 50, 15]"));
  EXPECT_THROW(begun("[10, 9, 50, 15]"), SceneError);
}

}  // namespace
}  // namespace clca::scene::room_test
