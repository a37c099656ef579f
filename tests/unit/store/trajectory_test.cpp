#include "clca/store/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "clca/automaton/automaton.hpp"
#include "clca/model/initial_state.hpp"
#include "clca/store/file.hpp"
#include "model/internal/scene_model.hpp"
#include "run/stage.hpp"
#include "support/runs.hpp"
#include "support/trajectories.hpp"

namespace clca::store::trajectory_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::kept_of;

constexpr double kMuch = 1e9;

/// What a run has shown: states and where they belong.
struct Shown {
  std::vector<grains::State> states;
  std::vector<std::size_t> stages;
};

class TrajectoryTest : public ::testing::Test {
 protected:
  /// Plays a scene; a part has `frames_per_part` frames.
  Shown write(const scene::Scene& scene, std::uint64_t every, std::size_t frames_per_part) const {
    const grains::State fixed = model::initial_state(scene);
    TrajectoryWriter writer(OutputFolder(run()), scene, fixed, {});
    Shown shown;
    testing::play(scene, every, [&](const grains::State& state, std::size_t stage, bool begins) {
      writer.add_frame(state, stage, begins);
      shown.states.push_back(kept_of(state, fixed));
      shown.stages.push_back(stage);
      if (shown.states.size() % frames_per_part == 0) {
        writer.flush();
      }
    });
    writer.flush();
    EXPECT_EQ(writer.written().frames, shown.states.size());
    return shown;
  }

  void expect_equal(const scene::Scene& scene, const Shown& shown) const {
    const Trajectory trajectory(run(), scene, model::initial_state(scene), kMuch);
    ASSERT_EQ(trajectory.frames().size(), shown.states.size());
    for (std::size_t frame = 0; frame < shown.states.size(); ++frame) {
      const grains::State state = trajectory.state(frame);
      ASSERT_EQ(state, shown.states[frame]) << "frame " << frame;
      EXPECT_EQ(trajectory.frames()[frame].step, state.step);
      EXPECT_EQ(trajectory.frames()[frame].stage, shown.stages[frame]);
      EXPECT_EQ(trajectory.frames()[frame].particles, present_count(state));
    }
  }

  std::string reason(const scene::Scene& scene, double max_bytes = kMuch) const {
    try {
      const Trajectory trajectory(run(), scene, model::initial_state(scene), max_bytes);
      for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
        trajectory.state(frame);
      }
    } catch (const StoreError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path run() const { return folder.path(); }
  std::filesystem::path part(int number) const {
    return run() / "trajectory" / ("part-00000" + std::to_string(number) + ".h5");
  }

  testing::ScratchFolder folder;
};

TEST_F(TrajectoryTest, StatesOfAPlateThatEntersABedAreReadAsTheyWere) {
  const scene::Scene scene = testing::plate_scene();
  const Shown shown = write(scene, 3, 1000);
  EXPECT_GT(shown.states.back().pushes.size(), 0U);
  expect_equal(scene, shown);
}

TEST_F(TrajectoryTest, StatesOfAnHourglassWithAPeriodicSeamAreReadAsTheyWere) {
  const scene::Scene scene = testing::hourglass_scene();
  const Shown shown = write(scene, 3, 7);
  const grains::State& last = shown.states.back();
  EXPECT_LT(present_count(last), last.particles.size()) << "nothing has left";
  EXPECT_TRUE(std::any_of(last.particles.begin(), last.particles.end(), [&](const auto& particle) {
    return particle.column < 0 || particle.column >= last.lattice.columns();
  })) << "nothing has gone across the seam";
  EXPECT_TRUE(std::any_of(shown.states.begin(), shown.states.end(), [](const auto& state) {
    return state.walls.front().travel.offset != 0;
  })) << "nothing was shaken";
  expect_equal(scene, shown);
}

TEST_F(TrajectoryTest, VelocitiesAndForcesOfTheContactModelAreReadAsTheyWere) {
  const scene::Scene scene = scene::parse(R"(clca: 1
model: contact
box: {width: 30, height: 40}
species: {grain: {shape: {hexagon: 1}}}
outlets: {drain: {region: [0, 0, 12, 6]}}
stages:
  - name: rain
    fill: {region: [0, 0, 30, 40], counts: {grain: 30}}
    until: {steps: 200}
output: {trajectory: {every: 20, contacts: true}}
)",
                                          "rain.yaml");
  model::SceneModel model(scene, run::state_at_start(scene), {});
  TrajectoryWriter writer(OutputFolder(run()), scene, model.state(), {});
  run::prepare_stage(model, scene, 0);
  std::vector<ContactFrame> shown;
  for (int step = 0; step <= 200; ++step) {
    if (step % 20 == 0) {
      ContactFrame frame = {
          .velocities = model.velocities(), .spins = model.spins(), .forces = model.forces()};
      const auto& grains = model.state().particles;
      std::erase_if(frame.forces, [&](const contact::Force& force) {
        return !grains[force.upper].present ||
               (grains::is_particle(force.other) &&
                !grains[static_cast<std::size_t>(force.other)].present);
      });
      writer.add_frame(model.state(), 0, step == 0, frame);
      for (std::size_t id = 0; id < frame.velocities.size(); ++id) {
        if (!grains[id].present) {
          frame.velocities[id].setZero();
          frame.spins[id] = 0;
        }
      }
      shown.push_back(frame);
    }
    if (step % 60 == 0) {
      writer.flush();
    }
    model.grains().step();
  }
  writer.flush();
  ASSERT_LT(present_count(model.state()), 30U) << "nothing has left";
  ASSERT_GT(shown.back().forces.size(), 10U);
  const Trajectory trajectory(run(), scene, model::initial_state(scene), kMuch);
  ASSERT_EQ(trajectory.frames().size(), shown.size());
  for (std::size_t frame = shown.size(); frame-- > 0;) {
    EXPECT_EQ(trajectory.contact_frame(frame), shown[frame]) << "frame " << frame;
  }
  EXPECT_THROW(writer.add_frame(model.state(), 0, false), std::invalid_argument) << "no velocities";
}

TEST_F(TrajectoryTest, FramesAreReadInAnyOrder) {
  const scene::Scene scene = testing::hourglass_scene();
  const Shown shown = write(scene, 5, 4);
  const Trajectory trajectory(run(), scene, model::initial_state(scene), kMuch);
  for (std::size_t i = 0; i < shown.states.size(); ++i) {
    const std::size_t frame = i * 17 % shown.states.size();
    ASSERT_EQ(trajectory.state(frame), shown.states[frame]) << "frame " << frame;
  }
  EXPECT_THROW(trajectory.state(shown.states.size()), std::out_of_range);
}

TEST_F(TrajectoryTest, AnAutomatonCanBeMadeOfAnyFrame) {
  const scene::Scene scene = testing::plate_scene();
  write(scene, 4, 10);
  const Trajectory trajectory(run(), scene, model::initial_state(scene), kMuch);
  for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
    EXPECT_NO_THROW(automaton::Automaton(trajectory.state(frame), scene.automaton_rules).step());
  }
}

/// The writer of a run that was killed and goes on.
TEST_F(TrajectoryTest, ARunGoesOnWhereItsCheckpointWas) {
  const scene::Scene scene = testing::hourglass_scene();
  const Shown shown = write(scene, 5, 4);
  const TrajectoryWriter::Written kept{.parts = 3, .frames = 12};
  write_whole_file(run() / "trajectory" / "notes.txt", "of the user");
  {
    TrajectoryWriter writer(OutputFolder(run()), scene, model::initial_state(scene), kept);
    EXPECT_FALSE(std::filesystem::exists(part(3))) << "later than the checkpoint";
    EXPECT_TRUE(std::filesystem::exists(run() / "trajectory" / "notes.txt"));
    EXPECT_EQ(writer.written().frames, 12U);
    std::size_t frame = 0;
    testing::play(scene, 5, [&](const grains::State& state, std::size_t stage, bool begins) {
      if (frame++ >= kept.frames) {
        writer.add_frame(state, stage, begins);
      }
    });
    writer.flush();
    EXPECT_EQ(writer.written().frames, shown.states.size());
    EXPECT_EQ(writer.written().parts, 4U);
  }
  expect_equal(scene, shown);
}

TEST_F(TrajectoryTest, ANewRunRemovesWhatAnOldOneHasLeft) {
  const scene::Scene scene = testing::plate_scene();
  write(scene, 5, 4);
  const TrajectoryWriter writer(OutputFolder(run()), scene, model::initial_state(scene), {});
  EXPECT_FALSE(std::filesystem::exists(run() / "trajectory.h5"));
  EXPECT_TRUE(std::filesystem::is_empty(run() / "trajectory"));
}

TEST_F(TrajectoryTest, ARunDoesNotGoOnWithPartsThatAreNotItsOwn) {
  const scene::Scene scene = testing::plate_scene();
  write(scene, 5, 4);
  const auto why = [&](const scene::Scene& of, const TrajectoryWriter::Written& kept) {
    try {
      const TrajectoryWriter writer(OutputFolder(run()), of, model::initial_state(of), kept);
    } catch (const StoreError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(why(scene, {.parts = 100, .frames = 400}),
              HasSubstr(".h5: missing, though the run had written it"));
  EXPECT_THAT(why(scene, {.parts = 2, .frames = 7}),
              HasSubstr("8 frames where the run had written 7"));
  EXPECT_THAT(why(testing::hourglass_scene(), {.parts = 2, .frames = 8}),
              EndsWith("part-000000.h5: of another scene: another lattice"));
  EXPECT_TRUE(std::filesystem::exists(part(2))) << "a run that cannot go on removes nothing";
}

TEST_F(TrajectoryTest, WhatIsInMemoryIsWrittenWhenItIsMuch) {
  const scene::Scene scene = testing::plate_scene();
  model::SceneModel model(scene, run::state_at_start(scene), {});
  run::prepare_stage(model, scene, 0);
  TrajectoryWriter writer(OutputFolder(run()), scene, model.state(), {});
  constexpr std::size_t kMaxFrames = (std::size_t{16} << 20U) / (std::size_t{80} * 33);
  for (std::size_t frame = 0; frame <= kMaxFrames; ++frame) {
    writer.add_frame(model.state(), 0, frame == 0);
  }
  EXPECT_EQ(writer.written().parts, 1U);
  EXPECT_GT(writer.written().frames, kMaxFrames * 9 / 10);
}

TEST_F(TrajectoryTest, FilesThatAreNotWholeAreRefused) {
  const scene::Scene scene = testing::plate_scene();
  EXPECT_THAT(reason(scene), HasSubstr("trajectory: no part there; a run writes them"));
  write(scene, 5, 8);
  ASSERT_EQ(reason(scene), "");
  const std::vector<std::uint8_t> whole = testing::bytes_of(part(1));
  auto bytes = whole;
  bytes.resize(bytes.size() / 2);
  write_whole_file(part(1), bytes);
  EXPECT_THAT(reason(scene), EndsWith("part-000001.h5: it is cut off"));
  bytes = whole;
  bytes[bytes.size() / 2] ^= 1U;
  write_whole_file(part(1), bytes);
  EXPECT_THAT(reason(scene), HasSubstr("part-000001.h5: "));
  EXPECT_THAT(reason(scene), HasSubstr("checksum is wrong"));
  std::filesystem::remove(part(1));
  EXPECT_THAT(reason(scene), EndsWith("part-000001.h5: missing, though later parts are there"));
  write_whole_file(part(1), whole);
  EXPECT_THAT(reason(testing::hourglass_scene()),
              EndsWith("part-000000.h5: of another scene: another lattice"));
  EXPECT_THAT(reason(scene, 1e4), HasSubstr("than the limit"));
  std::filesystem::copy_file(part(2), part(1), std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(reason(scene), EndsWith("part-000001.h5: rows of frames do not follow each other"));
}

TEST_F(TrajectoryTest, ATrajectoryOfAnotherSceneIsRefused) {
  write(testing::plate_scene(), 30, 100);
  const auto with = [&](const auto& change) {
    scene::Scene scene = testing::plate_scene();
    change(scene);
    return reason(scene);
  };
  EXPECT_THAT(with([](scene::Scene& scene) { scene.seed = 6; }), EndsWith("another seed"));
  EXPECT_THAT(with([](scene::Scene& scene) { scene.box.periodic = true; }),
              EndsWith("another lattice"));
  EXPECT_THAT(
      with([](scene::Scene& scene) { scene.species[0].shape = lattice::Shape::hexagon(0); }),
      EndsWith("other species"));
  EXPECT_THAT(with([](scene::Scene& scene) { scene.walls[0].name = "piston"; }),
              EndsWith("other walls"));
  EXPECT_THAT(with([](scene::Scene& scene) { scene.stages.pop_back(); }), EndsWith("other stages"));
}

}  // namespace
}  // namespace clca::store::trajectory_test
