// clca export as a user meets it, its files read back by the programs' own readers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "export/recorded_run.hpp"
#include "support/missing.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::export_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// A plate pushes into a bed behind a gate that is taken away.
constexpr const char* kPlate = R"(clca: 1
seed: 3
box: {width: 40, height: 50}
species:
  small: {shape: {hexagon: 1}}
  large: {shape: {hexagon: 2}}
walls:
  plate: {box: [12, 26, 19, 50], passive: overlap, motion: {direction: down, period: 2, distance: 20}}
  gate: {parts: [{box: [34, 0, 35, 30]}, {line: {from: [36, 4], to: [39, 10]}}]}
stages:
  - name: packing
    fill: {region: [0, 0, 33, 50], counts: {small: 30, large: 25}}
  - name: pushing
    insert: [plate]
    move: [plate]
    remove: [gate]
)";

/// Bent and straight particles enter an empty periodic box, drift across its seam and leave.
constexpr const char* kPeriodic = R"(clca: 1
seed: 4
box: {width: 24, height: 40, periodic: true}
rules: {inertia: 0.9, scatter: 0.7}
species:
  rod: {shape: {rod: {radius: 0, length: 4}}, orientations: any}
  hook: {shape: {sites: [[0, 0], [1, 0], [1, 1], [2, 1]]}, orientations: [0, 60, 120]}
sources:
  top: {region: [0, 34, 24, 38], species: {rod: 1, hook: 1}, rate: 0.7}
outlets:
  drain: {region: [0, 0, 6, 6]}
stages:
  - name: raining
    sources: [top]
    until: {steps: 100}
)";

/// Grains with spins, behind a gate that is taken away, and some that leave.
constexpr const char* kTurning = R"(clca: 1
model: contact
seed: 5
box: {width: 30, height: 40}
species:
  small: {shape: {hexagon: 1}}
  large: {shape: {hexagon: 2}}
walls:
  gate: {box: [18, 0, 19, 40]}
outlets:
  drain: {region: [26, 0, 30, 6]}
stages:
  - name: packing
    fill: {region: [0, 0, 18, 40], counts: {small: 15, large: 10}}
  - name: flow
    remove: [gate]
)";

class Export : public ::testing::Test {
 protected:
  void record(const char* scene, int steps = 100, int every = 6) const {
    testing::record(scene, run_, steps, every);
  }
  testing::ProgramResult call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "export");
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  /// What the reader says of an export of all frames.
  std::string read_back(const std::string& format, const std::string& ending) const {
    const auto result = call({"run", "--format", format});
    EXPECT_EQ(result.code, 0) << result.err;
    const fs::path file = run_ / "export" / ("recorded" + ending);
    EXPECT_THAT(result.out, HasSubstr("recorded" + ending));
    return output_of(std::string(CLCA_PYTHON) +
                     " " CLCA_SOURCE_DIR "/tests/export/read_exports.py " + format + " '" +
                     run_.string() + "' '" + file.string() + "' 2>&1");
  }

  static std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::string text;
    for (int character = 0; (character = std::fgetc(pipe.get())) != EOF;) {
      text += static_cast<char>(character);
    }
    return text;
  }

  std::size_t files_beside() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
  }

  testing::ScratchFolder folder_;
  fs::path run_ = folder_.path() / "run";
};

struct Named {
  const char* format;
  const char* ending;
};

class ReadBack : public Export, public ::testing::WithParamInterface<Named> {
 protected:
  void SetUp() override {
    if (std::string(CLCA_PYTHON).empty()) {
      CLCA_SKIP_AS_MISSING(
          "no python3 with h5py, gsd and vtk: apt-get install python3-h5py python3-gsd "
          "python3-vtk9");
    }
  }
  std::string read() const { return read_back(GetParam().format, GetParam().ending); }
};

TEST_P(ReadBack, ARunWithAPlateIsWhatItWas) {
  record(kPlate);
  const std::string said = read();
  EXPECT_THAT(said, HasSubstr("frames="));
  for (const char* nothing : {" forced=0 ", " moving=0 "}) {
    EXPECT_THAT(said, Not(HasSubstr(nothing)));
  }
}

TEST_P(ReadBack, AnEmptyPeriodicBoxThatFillsAndRunsOutIsWhatItWas) {
  record(kPeriodic);
  const std::string said = read();
  EXPECT_THAT(said, HasSubstr("frames="));
  for (const char* nothing : {" wrapped=0 ", " moving=0 ", " empty=0"}) {
    EXPECT_THAT(said, Not(HasSubstr(nothing)));
  }
}

TEST_P(ReadBack, ARunOfTheContactModelIsWhatItWas) {
  record(kTurning, 300, 30);
  const std::string said = read();
  EXPECT_THAT(said, HasSubstr("frames="));
  for (const char* nothing : {" turning=0 ", " moving=0 "}) {
    EXPECT_THAT(said, Not(HasSubstr(nothing)));
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReadBack,
                         ::testing::Values(Named{"vtp", ".pvd"}, Named{"gsd", ".gsd"},
                                           Named{"xyz", ".xyz"}, Named{"h5md", ".h5"}),
                         [](const auto& each) { return std::string(each.param.format); });

TEST_F(Export, TakesTheStepsThatAreAskedFor) {
  record(kPeriodic, 40, 5);
  const auto result = call(
      {"run", "--format", "xyz", "-o", "some.xyz", "--from", "5", "--to", "30", "--every", "10"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "3 frames\nsome.xyz\n");
  const auto bytes = testing::bytes_of(folder_.path() / "some.xyz");
  const std::string text(bytes.begin(), bytes.end());
  for (const char* step : {"Step=5 ", "Step=15 ", "Step=25 "}) {
    EXPECT_THAT(text, HasSubstr(step));
  }
  EXPECT_THAT(text, Not(HasSubstr("Step=30 ")));
  EXPECT_EQ(files_beside(), 2U);
}

TEST_F(Export, WallsThatStandAreWrittenOnce) {
  record(kPlate);
  EXPECT_EQ(call({"run", "--format", "vtp", "--to", "20"}).code, 0);
  std::size_t walls = 0;
  for (const auto& entry : fs::directory_iterator(run_ / "export")) {
    walls += entry.path().filename().string().find("-walls-") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(walls, 1U);
}

TEST_F(Export, WrongInputIsExitCodeTwoWithOneLineAndNoFile) {
  record(kPeriodic, 20, 5);
  fs::create_directories(folder_.path() / "untracked");
  fs::copy(run_ / "run.json", folder_.path() / "untracked/run.json");
  fs::copy(run_ / "scene.yaml", folder_.path() / "untracked/scene.yaml");
  fs::create_directories(folder_.path() / "gas");
  store::RunSummary gas;
  gas.kind = "boltzmann";
  gas.scene = "gas";
  store::write_whole(folder_.path() / "gas/run.json", store::to_json(gas));
  const std::size_t before = files_beside();
  for (const auto& [arguments, reason] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"run"}, "--format"},
           {{"run", "--format", "png"}, "png"},
           {{"nowhere", "--format", "gsd"}, "run.json"},
           {{"gas", "--format", "gsd"}, "Boltzmann"},
           {{"untracked", "--format", "gsd"}, "output.trajectory"},
           {{"run", "--format", "gsd", "--every", "0"}, "--every"},
           {{"run", "--format", "gsd", "--from", "21"}, "from step 0 to 20"},
           {{"run", "--format", "gsd", "--from", "9", "--to", "8"}, "no frame"},
           {{"run", "--format", "gsd", "--memory-limit", "1000"}, "--memory-limit"}}) {
    const auto result = call(arguments);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(reason));
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_FALSE(fs::exists(run_ / "export"));
  EXPECT_EQ(files_beside(), before);
}

TEST_F(Export, ADamagedTrajectoryIsWrongInput) {
  record(kPeriodic, 20, 5);
  const fs::path part = fs::directory_iterator(run_ / "trajectory")->path();
  auto bytes = testing::bytes_of(part);
  bytes[bytes.size() / 2] ^= 1U;
  store::write_whole(part, bytes);
  const auto result = call({"run", "--format", "gsd"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr(part.filename().string()));
  EXPECT_FALSE(fs::exists(run_ / "export"));
}

TEST_F(Export, AFullDiskIsAFailureThatLeavesNothingHalf) {
  record(kPlate);
  for (const char* format : {"vtp", "gsd", "xyz", "h5md"}) {
    const auto result = testing::run_program(
        {"export", "run", "--format", format, "-o", std::string("out/x.") + format},
        {.folder = folder_.path().string(), .file_size_limit = 3000});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, HasSubstr("cannot write out/"));
    EXPECT_TRUE(fs::is_empty(folder_.path() / "out"));
  }
}

}  // namespace
}  // namespace clca::export_test
