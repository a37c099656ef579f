// A bed of which a few grains move on is told apart from one that settles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "model/internal/scene_model.hpp"
#include "record/energy_record.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::record::rest_watch_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kBed = R"(clca: 1
model: contact
box: {width: 40, height: 40}
species: {grain: {shape: {hexagon: 0}}}
stages: [{name: rest, fill: {region: [0, 0, 40, 40], counts: {grain: 6}}}]
)";

/// Moves some grains of a bed by hand.
class RestWatchTest : public ::testing::Test {
 protected:
  /// To column `column`; others rest.
  std::optional<std::string> step(const std::vector<std::uint32_t>& ids, std::int32_t column) {
    for (grains::Particle& grain : state_.particles) {
      grain.previous = grains::kRest;
    }
    for (const std::uint32_t id : ids) {
      state_.particles[id].column = column;
      state_.particles[id].previous = static_cast<grains::Move>(lattice::kDirections.front());
    }
    return watch_.add_step(scene_, state_, ids.size());
  }
  /// Whether it warns while grains go to and fro over so many columns.
  bool warns(const std::vector<std::uint32_t>& ids, std::int32_t columns, std::uint64_t steps) {
    bool any = false;
    for (std::uint64_t i = 0; i < steps; ++i) {
      any = step(ids, static_cast<std::int32_t>(i) % columns).has_value() || any;
    }
    return any;
  }

  static grains::State bed(const scene::Scene& scene) {
    const model::ModelState empty = model::empty_state(scene);
    grains::State state = model::grains_of(empty);
    for (std::int32_t row = 0; row < 6; ++row) {
      state.particles.push_back({.row = 3 * row});
    }
    return state;
  }

  scene::Scene scene_ = scene::parse(kBed, "bed.yaml");
  grains::State state_ = bed(scene_);
  UnsettledBedDetector watch_;
};

TEST_F(RestWatchTest, WarnsOnceOfGrainsThatAloneMoveOn) {
  EXPECT_FALSE(warns({1, 3}, 3, UnsettledBedDetector::kMinSteps - 1));
  EXPECT_THAT(step({1, 3}, 0).value_or(""),
              AllOf(HasSubstr("for 2000 steps nothing has moved but particle 1 (grain) at x ="),
                    HasSubstr(", particle 3 (grain) at x =")));
  EXPECT_FALSE(warns({1, 3}, 3, 2 * UnsettledBedDetector::kMinSteps));
}

TEST_F(RestWatchTest, DoesNotWarnOfWhatSettles) {
  EXPECT_FALSE(warns({2}, 2, 2 * UnsettledBedDetector::kMinSteps))
      << "to a neighbouring site and back";
  EXPECT_FALSE(warns({0, 1, 2, 3}, 3, 2 * UnsettledBedDetector::kMinSteps)) << "too many";
  EXPECT_FALSE(warns({}, 1, 2 * UnsettledBedDetector::kMinSteps)) << "nothing moves";
}

TEST_F(RestWatchTest, BeginsAnewWithOtherGrainsAndWithOneThatComesLower) {
  EXPECT_FALSE(warns({0, 1, 2}, 3, UnsettledBedDetector::kMinSteps - 1));
  EXPECT_FALSE(warns({3}, 3, UnsettledBedDetector::kMinSteps - 1));
  --state_.particles[3].row;
  EXPECT_FALSE(warns({3}, 3, UnsettledBedDetector::kMinSteps - 1));
  EXPECT_TRUE(warns({3}, 3, 10));
}

TEST_F(RestWatchTest, BeginsAnewWithAGrainThatFlies) {
  EXPECT_FALSE(warns({3}, 3, UnsettledBedDetector::kMinSteps - 1));
  state_.particles[3].row += 4;
  EXPECT_FALSE(warns({3}, 3, UnsettledBedDetector::kMinSteps - 1));
  EXPECT_TRUE(warns({3}, 3, 10));
}

TEST(ARun, SaysEarlyThatAGrainDoesNotComeToRest) {
  constexpr const char* kSlide = R"(clca: 1
model: contact
box: {width: 30, height: 20, periodic: true}
species: {grain: {shape: {hexagon: 1}}}
contact: {friction: 0, wall_friction: 0, rolling: none, resolution: 0.2}
stages:
  - {name: slide, fill: {region: [0, 0, 30, 5], counts: {grain: 1}}, vessel: {tilt: 10}, max_steps: 6000}
)";
  const testing::ScratchFolder folder;
  std::vector<std::string> warnings;
  run::run(scene::parse(kSlide, "slide.yaml"), {.folder = folder.path() / "out"},
           {.warning = [&](const std::string& line) {
             if (line.find("no rest") != std::string::npos) {
               warnings.push_back(line);
             }
           }});
  EXPECT_THAT(warnings,
              ElementsAre(AllOf(HasSubstr("stage slide, step 2"), HasSubstr("particle 0 (grain)"),
                                HasSubstr("up to max_steps (6000)"))));
}

}  // namespace
}  // namespace clca::record::rest_watch_test
