// Runs in a folder that behaves as on NFS (like_nfs.c).

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "clca/store/checkpoint.hpp"
#include "clca/store/output_folder.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::like_nfs_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(
clca: 1
seed: 1
box: {width: 40, height: 30}
species: {grain: {shape: {hexagon: 1}}}
stages:
  - {name: packing, fill: {region: [0, 0, 12, 30], counts: {grain: 15}}, until: {steps: 20}}
output:
  frames: none
  series: {every: 1}
  trajectory: {every: 4}
)";

class LikeNfs : public ::testing::Test {
 protected:
  LikeNfs() { std::ofstream(path("scene.yaml")) << kScene; }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  testing::ProgramResult clca(std::vector<std::string> arguments) const {
    return testing::run_program(
        std::move(arguments),
        {.environment = {{"LD_PRELOAD", CLCA_LIKE_NFS}, {"CLCA_NFS_GAP", "100"}}});
  }
  testing::ProgramResult run(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", path("scene.yaml").string(), "-o", path("out").string()});
    return clca(std::move(more));
  }

  testing::ScratchFolder folder_;
};

TEST_F(LikeNfs, RunsAndSweepsWorkAndLeaveNoOtherFiles) {
  const auto first = run();
  ASSERT_EQ(first.code, 0) << first.err;
  const auto replacing = run();
  ASSERT_EQ(replacing.code, 0) << replacing.err;
  const auto resumed = clca({"resume", path("out").string(), "--until", "40"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  const auto sweep =
      clca({"sweep", path("scene.yaml").string(), "--seeds", "1..3", "-o", path("sweep").string()});
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(!name.starts_with(".clca-") && !name.starts_with(".nfs")) << entry.path();
  }
}

TEST_F(LikeNfs, TemporaryFilesOfKilledProcessesAreRemoved) {
  ASSERT_EQ(run().code, 0);
  std::ofstream(path("out/.clca.manifest"), std::ios::app) << "temporary \"0123456789abcdef\"\n";
  std::ofstream(path("out/.clca-0123456789abcdef-7")) << "half a file";
  std::ofstream(path("out/.clca-mine-7")) << "of the user";
  ASSERT_EQ(run().code, 0);
  EXPECT_FALSE(fs::exists(path("out/.clca-0123456789abcdef-7")));
  EXPECT_TRUE(fs::exists(path("out/.clca-mine-7")));
}

TEST_F(LikeNfs, OthersFindTheManifestWhileItIsReplaced) {
  ASSERT_EQ(run().code, 0);
  std::atomic<bool> ended = false;
  std::thread others([&] {
    while (!ended) {
      EXPECT_TRUE(store::OutputFolder(path("out")).owns(store::kCheckpointFile));
    }
  });
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(run().code, 0);
  }
  ended = true;
  others.join();
}

}  // namespace
}  // namespace clca::like_nfs_test
