#include "clca/store/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "clca/automaton/automaton.hpp"
#include "clca/store/file.hpp"
#include "store/sealed_file.hpp"
#include "support/runs.hpp"
#include "support/trajectories.hpp"

namespace clca::store {
namespace {

using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::kept_of;

constexpr double kMuch = 1e9;

/// What a run has shown: states and where they belong.
struct Shown {
  std::vector<automaton::State> states;
  std::vector<std::size_t> stages;
};

class TrajectoryTest : public ::testing::Test {
 protected:
  /// Plays a scene; a part has `frames_per_part` frames.
  Shown write(const scene::Scene& scene, std::uint64_t every, std::size_t frames_per_part) const {
    const automaton::State fixed = run::initial_state(scene);
    TrajectoryWriter writer(run(), scene, fixed, {});
    Shown shown;
    testing::play(scene, every, [&](const automaton::State& state, std::size_t stage, bool begins) {
      writer.add(state, stage, begins);
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
    const Trajectory trajectory(run(), scene, run::initial_state(scene), kMuch);
    ASSERT_EQ(trajectory.frames().size(), shown.states.size());
    for (std::size_t frame = 0; frame < shown.states.size(); ++frame) {
      const automaton::State state = trajectory.state(frame);
      ASSERT_EQ(state, shown.states[frame]) << "frame " << frame;
      EXPECT_EQ(trajectory.frames()[frame].step, state.step);
      EXPECT_EQ(trajectory.frames()[frame].stage, shown.stages[frame]);
      EXPECT_EQ(trajectory.frames()[frame].particles, present_count(state));
    }
  }

  std::string reason(const scene::Scene& scene, double most_bytes = kMuch) const {
    try {
      const Trajectory trajectory(run(), scene, run::initial_state(scene), most_bytes);
      for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
        trajectory.state(frame);
      }
    } catch (const StoreError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path run() const { return folder_.path(); }
  std::filesystem::path part(int number) const {
    return run() / "trajectory" / ("part-00000" + std::to_string(number) + ".h5");
  }

  testing::ScratchFolder folder_;
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
  const automaton::State& last = shown.states.back();
  EXPECT_LT(present_count(last), last.particles.size()) << "nothing has left";
  EXPECT_TRUE(std::any_of(last.particles.begin(), last.particles.end(), [&](const auto& particle) {
    return particle.column < 0 || particle.column >= last.lattice.columns();
  })) << "nothing has gone across the seam";
  EXPECT_TRUE(std::any_of(shown.states.begin(), shown.states.end(), [](const auto& state) {
    return state.walls.front().travel.offset != 0;
  })) << "nothing was shaken";
  expect_equal(scene, shown);
}

TEST_F(TrajectoryTest, FramesAreReadInAnyOrder) {
  const scene::Scene scene = testing::hourglass_scene();
  const Shown shown = write(scene, 5, 4);
  const Trajectory trajectory(run(), scene, run::initial_state(scene), kMuch);
  for (std::size_t i = 0; i < shown.states.size(); ++i) {
    const std::size_t frame = i * 17 % shown.states.size();
    ASSERT_EQ(trajectory.state(frame), shown.states[frame]) << "frame " << frame;
  }
  EXPECT_THROW(trajectory.state(shown.states.size()), std::out_of_range);
}

TEST_F(TrajectoryTest, AnAutomatonCanBeMadeOfAnyFrame) {
  const scene::Scene scene = testing::plate_scene();
  write(scene, 4, 10);
  const Trajectory trajectory(run(), scene, run::initial_state(scene), kMuch);
  for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
    EXPECT_NO_THROW(automaton::Automaton(trajectory.state(frame)).step());
  }
}

}  // namespace
}  // namespace clca::store
