// Files of the user's, of any name, are after every command what they were before.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::user_files_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(clca: 1
box: {width: 24, height: 30}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [12, 0, 13, 30]}}
stages:
  - {name: packing, fill: {region: [0, 0, 12, 30], counts: {grain: 15}}, until: {steps: 8}}
  - {name: flow, remove: [gate], until: {steps: 24}}
output:
  frames: {every: 8, width: 64, height: 64, caption: false}
  fields: {every: 8}
  trajectory: {every: 8}
)";

constexpr const char* kGas = R"(clca: 1
boltzmann: {particles: 200, restitution: 0.9, friction: 0.3, until: 1}
output: {series: {every: 0.5}, histograms: [0, 1], bins: q20}
)";

/// What commands write, and much that looks like it.
const std::vector<std::string>& names() {
  static const std::vector<std::string> all = {"a.txt",
                                               "lock",
                                               "book.part-2",
                                               "series.csv.part-17",
                                               "profile-me.csv",
                                               "profile-flow.csv.bak",
                                               "Series.csv",
                                               "series.csv~",
                                               "run.json.old",
                                               "scene.yml",
                                               "log.txt.1",
                                               "checkpoint.h5",
                                               "checkpoint-next.h5",
                                               "checkpoint.clca.bak",
                                               "notes with blanks",
                                               "\xC3\xA4.csv",
                                               "-o",
                                               "--help",
                                               "trajectory.h5.part-9",
                                               ".hidden",
                                               ".clca",
                                               ".clca-0123456789abcdef-1",
                                               ".clca-x",
                                               ".clca.lock~",
                                               "thesis.tex",
                                               "report.htm",
                                               "frames/mine.png",
                                               "frames/scene-999999.png",
                                               "frames/scene-000000.PNG",
                                               "plots/mine.png",
                                               "plots/series.gp",
                                               "export/mine.vtp",
                                               "export/scene-999999.vtp",
                                               "render/mine.png",
                                               "render/scene-999999.png",
                                               "trajectory/part-999999.h5",
                                               "trajectory/notes",
                                               "runs/mine/run.json",
                                               "runs/notes.txt",
                                               "histogram-0.5.csv",
                                               "histogram-x.csv",
                                               "walls-mine.csv",
                                               "contacts-mine.csv",
                                               "loads-mine.csv",
                                               "forces-mine.csv",
                                               "cycles.csv.gz",
                                               "overview.jpg",
                                               "comparison.csv.old",
                                               "distances.txt",
                                               "sweep.json.old"};
  return all;
}

class UserFiles : public ::testing::Test {
 protected:
  UserFiles() {
    std::ofstream(path("scene.yaml")) << kScene;
    std::ofstream(path("gas.yaml")) << kGas;
    EXPECT_EQ(run({"run", "scene.yaml", "-o", "earlier", "--quiet"}).code, 0);
    EXPECT_EQ(run({"run", "gas.yaml", "-o", "gas", "--quiet"}).code, 0);
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  testing::ProgramResult run(const std::vector<std::string>& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  /// Names in `folder` become files of the user's, where nothing is there.
  void put(const std::string& folder, const std::vector<std::string>& all) {
    for (const std::string& name : all) {
      const fs::path file = path(folder) / name;
      if (!fs::exists(file)) {
        fs::create_directories(file.parent_path());
        std::ofstream(file) << "mine: " << name;
        mine_[file] = "mine: " + name;
      }
    }
  }
  void expect_untouched(const std::string& after) const {
    for (const auto& [file, text] : mine_) {
      std::ifstream stream(file);
      EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), text)
          << file << " after " << after;
    }
  }
  void expect_untouched(const std::vector<std::vector<std::string>>& commands) {
    for (const auto& command : commands) {
      const auto result = run(command);
      EXPECT_GE(result.code, 0) << result.err;
      expect_untouched(::testing::PrintToString(command) + result.err);
    }
  }

  testing::ScratchFolder folder_;
  std::map<fs::path, std::string> mine_;
};

TEST_F(UserFiles, BesideThoseOfARunStayAsTheyAreUnderEveryCommand) {
  put("earlier", names());
  ASSERT_GE(mine_.size(), 49U);
  expect_untouched({{"resume", "earlier"},
                    {"resume", "earlier", "--until", "30"},
                    {"check", "earlier/scene.yaml"},
                    {"plot", "earlier"},
                    {"report", "earlier"},
                    {"render", "earlier"},
                    {"render", "earlier", "--sheet", "earlier/sheet.png"},
                    {"export", "earlier", "--format", "vtp"},
                    {"export", "earlier", "--format", "gsd"},
                    {"diff", "earlier/render/scene-000000.png", "earlier/render/scene-000008.png",
                     "-o", "earlier/difference.png"},
                    {"compare", "earlier", "gas", "-o", "earlier/beside"},
                    {"run", "scene.yaml", "-o", "earlier"},
                    {"run", "scene.yaml", "-o", "earlier", "--overwrite", "--frames-every", "0"},
                    {"boltzmann", "gas.yaml", "-o", "earlier"},
                    {"sweep", "scene.yaml", "--seeds", "1..2", "-o", "earlier"}});
}

TEST_F(UserFiles, InAFolderOfTheirOwnStayAsTheyAreUnderEveryCommand) {
  put("mine", names());
  expect_untouched({{"resume", "mine"},
                    {"plot", "mine"},
                    {"plot", "earlier", "-o", "mine"},
                    {"plot", "gas", "-o", "mine"},
                    {"report", "mine"},
                    {"report", "earlier", "-o", "mine/page.html"},
                    {"render", "mine"},
                    {"render", "earlier", "-o", "mine"},
                    {"export", "mine", "--format", "xyz"},
                    {"export", "earlier", "--format", "vtp", "-o", "mine/all.pvd"},
                    {"compare", "earlier", "gas", "-o", "mine"},
                    {"run", "scene.yaml", "-o", "mine"},
                    {"sweep", "scene.yaml", "--seeds", "1..2", "-o", "mine"}});
}

TEST_F(UserFiles, KeepAFolderTheirOwnWhateverTheirNames) {
  for (const std::string name : {"run.json", "sweep.json", "frames/scene-000000.png", "a.txt"}) {
    const std::string folder = "of-" + std::to_string(mine_.size());
    put(folder, {name});
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"run", "scene.yaml", "-o", folder, "--overwrite"},
          {"run", "gas.yaml", "-o", folder, "--overwrite"},
          {"sweep", "scene.yaml", "--seeds", "1", "-o", folder},
          {"plot", "earlier", "-o", folder},
          {"render", "earlier", "-o", folder},
          {"compare", "earlier", "gas", "-o", folder}}) {
      const auto result = run(command);
      expect_untouched(::testing::PrintToString(command) + result.err);
      EXPECT_NE(result.code, 0) << ::testing::PrintToString(command);
      EXPECT_THAT(result.err, ::testing::MatchesRegex(
                                  "clca: error: [^\n]*clca did not make the folder[^\n]*\n"));
    }
  }
}

TEST_F(UserFiles, BehindSymbolicLinksAreNotReached) {
  put("far", {"frames/scene-000000.png", "series.csv", "profile-flow.csv", "part-000000.h5"});
  for (const char* name :
       {"frames", "plots", "render", "export", "trajectory", "series.csv", "log.txt", "run.json",
        "checkpoint.clca", ".clca.lock", ".clca.manifest"}) {
    const std::string folder = std::string("linked-") + name;
    fs::copy(path("earlier"), path(folder), fs::copy_options::recursive);
    fs::remove_all(path(folder) / name);
    fs::create_symlink(path("far") / (name[0] == 's' ? "series.csv" : "frames"),
                       path(folder) / name);
    expect_untouched({{"resume", folder},
                      {"resume", folder, "--until", "30"},
                      {"plot", folder},
                      {"render", folder},
                      {"export", folder, "--format", "xyz"},
                      {"run", "scene.yaml", "-o", folder, "--overwrite"}});
    EXPECT_TRUE(fs::is_symlink(path(folder) / name)) << name;
  }
}

}  // namespace
}  // namespace clca::user_files_test
