// Runs of the contact model: what they leave, and that they go on as if they had never been
// stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::run {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr double kMuch = 1e9;

constexpr const char* kSmall = R"(clca: 1
model: contact
seed: 3
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [20, 0, 21, 60], friction: 0.1}}
sources: {spout: {region: [4, 50, 12, 54], species: {grain: 1}, rate: 0.05, count: 4}}
outlets: {drain: {region: [22, 0, 41, 8]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 60], counts: {grain: 40}}
    until: {steps: 300}
  - name: flow
    remove: [gate]
    sources: [spout]
    until: {steps: 300}
measure: [profile, packing, moved, outflow]
output:
  frames: {every: 100, width: 96, height: 64, color_by: displacement}
  series: {every: 1}
  trajectory: {every: 10}
  checkpoint: {every: 50}
)";

class ContactRunTest : public ::testing::Test {
 protected:
  scene::Scene small(const std::vector<scene::Override>& overrides = {}) const {
    return scene::parse(kSmall, "small.yaml", overrides);
  }
  fs::path path(const char* name = "run") const { return folder_.path() / name; }

  testing::ScratchFolder folder_;
};

TEST_F(ContactRunTest, TheSeriesHasItsEnergies) {
  run(small(), {.folder = path()});
  const auto kinetic = testing::csv_column(path() / "series.csv", "kinetic_energy");
  const auto potential = testing::csv_column(path() / "series.csv", "potential_energy");
  const auto discharged = testing::csv_column(path() / "series.csv", "discharged_particles");
  ASSERT_EQ(kinetic.size(), 601U);
  EXPECT_EQ(kinetic.front(), 0);
  EXPECT_GT(potential.front(), 40 * 7 * 10);
  EXPECT_GT(*std::max_element(kinetic.begin(), kinetic.end()), 0);
  // While nothing enters, what falls only gains what it loses, but for what rest forgets.
  for (std::size_t step = 0; step <= 300; ++step) {
    EXPECT_LE(kinetic[step] + potential[step], 1.005 * potential.front());
  }
  EXPECT_GT(discharged.back(), 0);
}

TEST_F(ContactRunTest, TheSeriesOfAnAutomatonHasNone) {
  run(small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}"}), {.folder = path()});
  EXPECT_THROW(testing::csv_column(path() / "series.csv", "kinetic_energy"), std::out_of_range);
}

TEST_F(ContactRunTest, TheReferenceEngineLeavesTheSameRun) {
  const auto fast = run(small(), {.folder = path("fast"), .threads = 2});
  const auto reference = run(small(), {.folder = path("reference"), .reference = true});
  EXPECT_EQ(reference.state_hash, fast.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("fast"), path("reference")), "");
}

TEST_F(ContactRunTest, AReferenceOfTheAutomatonIsRefused) {
  const auto scene = small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}"});
  EXPECT_THAT([&] { run(scene, {.folder = path(), .reference = true}); },
              ::testing::ThrowsMessage<ScenePlaceError>(
                  HasSubstr("--engine reference: error: only model contact has this engine")));
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(ContactRunTest, StoppedTimeAndAgainARunIsTheSameAsInOneGo) {
  const auto expected = run(small(), {.folder = path("unbroken")});
  std::atomic<int> stop = 0;
  std::uint64_t until = 0;
  const RunEvents events = {
      .progress = [&](const Progress& at) { stop = at.step >= until ? 15 : 0; },
      .progress_interval = {}};
  run(small(), {.folder = path(), .stop = &stop}, events);
  for (const std::uint64_t next : {7U, 133U, 300U, 301U, 444U}) {
    until = next;
    stop = 0;
    EXPECT_EQ(
        resume(load_run(path(), kMuch), {.reference = next == 133U, .stop = &stop}, events).status,
        "interrupted");
  }
  EXPECT_EQ(resume(load_run(path(), kMuch), {.time_limit = 0.0}).status, "interrupted");
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).state_hash, expected.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("unbroken"), path()), "");
}

// Contents that no run has saved, under a right checksum.
TEST_F(ContactRunTest, AHostileCheckpointIsRefused) {
  std::atomic<int> stop = 0;
  run(small(), {.folder = path(), .stop = &stop},
      {.progress = [&](const Progress& at) { stop = at.step >= 400 ? 2 : 0; },
       .progress_interval = {}});
  const auto original = store::read_checkpoint(path(), kMuch)->checkpoint;
  const auto refusal = [&](const auto& damage) {
    auto checkpoint = original;
    damage(checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    const std::atomic<int> at_once = 2;
    try {
      resume(load_run(path(), kMuch), {.stop = &at_once});
    } catch (const store::StoreError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto column = [](const std::string& name, auto value) {
    return [=](store::Checkpoint& checkpoint) {
      std::get<std::vector<decltype(value)>>(checkpoint.fields.at(name)).at(0) = value;
    };
  };
  constexpr std::int32_t kGreatest = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(refusal([](store::Checkpoint&) {}), "");
  EXPECT_THAT(refusal([](store::Checkpoint& one) { one.fields.erase("state/velocities/spin"); }),
              EndsWith("state/velocities/spin is missing"));
  EXPECT_THAT(refusal(column("state/velocities/x", kGreatest)),
              EndsWith("a velocity is out of range"));
  EXPECT_THAT(refusal(column("state/remainders/y", -kGreatest)),
              EndsWith("a remainder is out of range"));
  EXPECT_THAT(refusal(column("state/contacts/impulse/normal", std::int32_t{-1})),
              EndsWith("an impulse is out of range"));
  EXPECT_THAT(refusal(column("state/contacts/upper", std::uint32_t{1000})),
              EndsWith("a contact is not one of two bodies"));
  EXPECT_THAT(refusal(column("state/contacts/other", std::int32_t{-1})),
              EndsWith("a contact is not one of two bodies"));
  EXPECT_THAT(refusal(column("state/contacts/size", std::uint64_t{1} << 40U)),
              EndsWith("state/contacts needs more memory than the limit"));
  EXPECT_THAT(refusal(column("state/grains/particles/kind", std::uint16_t{9})),
              EndsWith("a particle is of no kind"));
  EXPECT_THAT(refusal(column("state/grains/seed", std::uint64_t{9})),
              EndsWith("the seed is not that of the scene"));
}

}  // namespace
}  // namespace clca::run
