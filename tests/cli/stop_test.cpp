// Signals while another program hangs, and hang-ups.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"
#include "support/stored_run.hpp"

namespace clca::stop_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kScene = R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
stages:
  - {name: packing, fill: {region: [0, 0, 30, 60], counts: {small: 60}}}
output:
  frames: {every: 10, width: 640, height: 480}
)";

class StopTest : public ::testing::Test {
 protected:
  /// A program of that name that runs a command, tells its process id and then does nothing.
  void hang(const std::string& name, const std::string& first = ":") const {
    fs::create_directories(folder_.path() / "bin");
    const fs::path file = folder_.path() / "bin" / name;
    std::ofstream(file) << "#!/bin/sh\n"
                        << first << "\necho $$ > " << (folder_.path() / "pid").string()
                        << "\nexec /bin/sleep 1000\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  /// Sends the signal once that program runs.
  testing::ProgramResult stopped(const std::vector<std::string>& arguments, int signal) const {
    return testing::run_program(
        arguments, {.folder = folder_.path().string(),
                    .environment = {{"PATH", (folder_.path() / "bin").string()},
                                    {"CLCA_PYTHON", (folder_.path() / "bin/python3").string()}},
                    .signal = signal,
                    .once = "pid",
                    .once_has = "\n"});
  }
  void expect_ended(const testing::ProgramResult& result, int signal) const {
    EXPECT_EQ(result.code, 128 + signal) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    pid_t child = 0;
    std::ifstream(folder_.path() / "pid") >> child;
    EXPECT_TRUE(::kill(child, 0) != 0 && errno == ESRCH) << "the program still runs";
  }

  testing::ScratchFolder folder_;
};

TEST_F(StopTest, TheFirstSignalEndsAnFfmpegThatHangsAndLeavesNothingOfTheMovie) {
  testing::run_and_store(scene::parse(kScene, "small.yaml"), folder_.path() / "run", 2);
  hang("ffmpeg", "/usr/bin/head -c 1 > /dev/null");  // until the first picture is on its way
  expect_ended(stopped({"render", "run", "--movie", "a.mp4", "--quiet"}, SIGINT), SIGINT);
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("a.mp4")));
  }
}

TEST_F(StopTest, TheFirstSignalEndsAPythonThatHangs) {
  store::RunSummary summary;
  summary.kind = "boltzmann";
  summary.scene = "gas";
  store::write_whole_file(folder_.path() / "run.json", store::to_json(summary));
  store::write_whole_file(folder_.path() / "series.csv", "time,collisions\n0,0\n1,2\n");
  hang("python3");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    expect_ended(stopped({"plot", ".", "-o", "plots"}, signal), signal);
    EXPECT_FALSE(fs::exists(folder_.path() / "plots"));
    fs::remove(folder_.path() / "pid");
  }
}

TEST_F(StopTest, AHangUpThatWasIgnoredFromTheBeginningStaysSo) {
  std::ofstream(folder_.path() / "small.yaml") << kScene;
  const auto result = testing::run_program(
      {"-c", "trap '' HUP; exec \"$0\" run small.yaml -o out --quiet", CLCA_PROGRAM},
      {.folder = folder_.path().string(),
       .signal = SIGHUP,
       .once = "out/run.json",
       .program = "/bin/sh"});
  EXPECT_EQ(result.code, 0) << result.err;
}

}  // namespace
}  // namespace clca::stop_test
