// What other programs see of a trajectory: h5py, by the example of docs/trajectory.md.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "clca/model/initial_state.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/trajectory.hpp"
#include "support/missing.hpp"
#include "support/runs.hpp"
#include "support/states.hpp"
#include "support/trajectories.hpp"

namespace clca::store::trajectory_python_test {
namespace {

/// What a command writes; "failed" after it where it ends with an error.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> block{};
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe)) {
    text.append(block.data(), size);
  }
  return ::pclose(pipe) == 0 ? text : text + "failed";
}

/// As the column mean_height of series.csv has it.
double mean_height(const grains::State& state) {
  double sum = 0;
  double weight = 0;
  for (const grains::Particle& particle : state.particles) {
    if (particle.present) {
      const auto sites = static_cast<double>(state.shape(particle).size());
      sum += sites * grains::centre(state, particle).y();
      weight += sites;
    }
  }
  return weight > 0 ? sum / weight : 0;
}

class TrajectoryInPython : public ::testing::Test {
 protected:
  void SetUp() override {
    if (output_of("/usr/bin/python3 -c 'import h5py, numpy'") != "") {
      CLCA_SKIP_AS_MISSING("/usr/bin/python3 has no h5py (python3-h5py)");
    }
  }

  void write(const scene::Scene& scene) {
    TrajectoryWriter writer(OutputFolder(run()), scene, model::initial_state(scene), {});
    testing::play(scene, 5, [&](const grains::State& state, std::size_t stage, bool begins) {
      writer.add_frame(state, stage, begins);
      if (++frames_ % 4 == 0) {
        writer.flush();
      }
      lines_.push_back(fmt::format("{} {} {} {:.9g}", state.step, scene.stages[stage].name,
                                   present_count(state), mean_height(state)));
      for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
        const Eigen::Vector2d shift = lattice::position(state.walls[wall].shift());
        if (state.walls[wall].present) {
          lines_.back() += fmt::format(" {}=({:.9g},{:.9g})", scene.walls[wall].name, shift.x() + 0,
                                       shift.y() + 0);
        }
      }
    });
    writer.flush();
  }

  std::vector<std::string> lines_of_example(const std::filesystem::path& folder) const {
    std::istringstream text(
        output_of(fmt::format("cd / && /usr/bin/python3 {}/examples/"
                              "read_trajectory.py {}",
                              CLCA_SOURCE_DIR, folder.string())));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    return lines;
  }

  std::filesystem::path run() const { return folder_.path() / "run"; }

  testing::ScratchFolder folder_;
  std::size_t frames_ = 0;
  std::vector<std::string> lines_;
};

TEST_F(TrajectoryInPython, TheExampleShowsWhatTheProgramHas) {
  std::filesystem::create_directories(run());
  write(testing::plate_scene());
  EXPECT_EQ(lines_of_example(run()), lines_);
  const std::filesystem::path moved = folder_.path() / "elsewhere";
  std::filesystem::rename(run(), moved);
  EXPECT_EQ(lines_of_example(moved), lines_) << "moved to another folder";
}

TEST_F(TrajectoryInPython, TheExampleGoesAcrossASeam) {
  std::filesystem::create_directories(run());
  write(testing::hourglass_scene());
  EXPECT_EQ(lines_of_example(run()), lines_);
}

TEST_F(TrajectoryInPython, TheExampleAddsTheForcesOnTheFloor) {
  std::filesystem::create_directories(run());
  const scene::Scene scene = scene::parse(R"(clca: 1
model: contact
box: {width: 20, height: 20}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: only, fill: {region: [0, 0, 20, 20], counts: {grain: 1}}}]
output: {trajectory: {contacts: true}}
)",
                                          "one.yaml");
  grains::State state = model::initial_state(scene);
  state.particles = {testing::particle_at(5, 5)};
  state.origins = {{5, 5}};
  contact::Force force = {.other = contact::kFloor, .point = {5, 5}, .normal_force = 2.5};
  ContactFrame frame = {.velocities = {{0, 0}}, .spins = {0}, .forces = {force, force}};
  frame.forces[1].other = contact::kLeftSide;
  TrajectoryWriter writer(OutputFolder(run()), scene, state, {});
  writer.add_frame(state, 0, true, frame);
  writer.flush();
  EXPECT_EQ(lines_of_example(run()), std::vector<std::string>({"0 only 1 5.5 floor=2.5"}));
}

TEST_F(TrajectoryInPython, TheIndexShowsAllPartsAsOne) {
  std::filesystem::create_directories(run());
  write(testing::plate_scene());
  const std::filesystem::path script = folder_.path() / "compare.py";
  std::ofstream(script) << R"(
import glob, sys, h5py, numpy
run = sys.argv[1]
parts = [h5py.File(name) for name in sorted(glob.glob(run + "/trajectory/part-*.h5"))]
seen = []
def compare(name, item):
    if isinstance(item, h5py.Dataset):
        of_parts = numpy.concatenate([part[name][:] for part in parts])
        assert item.dtype == of_parts.dtype, name
        assert numpy.array_equal(item[:].reshape(of_parts.shape), of_parts), name
        seen.append(name)
def describe(name, item):
    if isinstance(item, h5py.Dataset):
        assert isinstance(item.attrs["units"], str) and item.attrs["description"], name
        described.append(name)
described = []
for part in parts:
    part.visititems(describe)
with h5py.File(run + "/trajectory.h5") as index:
    index.visititems(describe)
    assert index["particles/position"].attrs["units"] == "spacings"
    for group in ["frames", "particles", "origins", "pushes", "walls"]:
        index[group].visititems(lambda name, item: compare(group + "/" + name, item))
    assert index["walls/position"].shape == (len(index["frames/step"]), 1, 2)
    assert index["scene/species"][:].tolist() == [b"small", b"large"]
    assert index["pushes/pushed"].shape[0] > 0
print(len(parts), len(seen), len(described))
)";
  EXPECT_EQ(output_of(fmt::format("/usr/bin/python3 {} {}", script.string(), run().string())),
            "7 24 297\n");
}

TEST_F(TrajectoryInPython, APartThatIsNotThereIsNotTakenForValues) {
  std::filesystem::create_directories(run());
  write(testing::plate_scene());
  std::filesystem::remove(run() / "trajectory" / "part-000003.h5");
  EXPECT_EQ(output_of(fmt::format(
                "/usr/bin/python3 -c 'import h5py, numpy; f = h5py.File(\"{}/trajectory.h5\"); "
                "x = f[\"particles/position\"][:]; i = f[\"particles/id\"][:]; "
                "print(numpy.isnan(x).sum(), (i == 2**32 - 1).sum(), (i < 80).sum(), "
                "(f[\"walls/offset\"][:] == -2**31).sum())'",
                run().string())),
            "640 320 1920 4\n");
}

}  // namespace
}  // namespace clca::store::trajectory_python_test
