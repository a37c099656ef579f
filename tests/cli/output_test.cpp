// What the program prints, and where it cannot.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::output_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kFull =
    "clca: error: cannot write to standard output: No space left on device\n";
constexpr const char* kClosed =
    "clca: error: cannot write to standard output: Bad file descriptor\n";
constexpr int kSigPipe = 141;

class OutputTest : public ::testing::Test {
 protected:
  OutputTest() {
    std::ofstream(folder_.path() / "small.yaml") << R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
stages:
  - {name: packing, fill: {region: [0, 0, 30, 60], counts: {small: 30}}}
)";
  }
  /// As a shell has it, `clca` being the program.
  testing::ProgramResult shell(std::string line) const {
    const std::string program = CLCA_PROGRAM;
    for (std::size_t at = line.find("clca "); at != std::string::npos;
         at = line.find("clca ", at + program.size())) {
      line.replace(at, 4, program);
    }
    return testing::run_program({"-c", line},
                                {.folder = folder_.path().string(), .program = "/bin/sh"});
  }
  std::string text(const std::string& file) const {
    const auto bytes = testing::bytes_of(folder_.path() / file);
    return {bytes.begin(), bytes.end()};
  }

  testing::ScratchFolder folder_;
};

TEST_F(OutputTest, AFullDeviceIsOneLineAndExitCodeOneWhateverIsPrinted) {
  for (const char* arguments : {"check small.yaml", "--help", "run --help", "--version",
                                "run small.yaml", "sweep small.yaml --seeds 1..2"}) {
    const auto result = shell(std::string("clca ") + arguments + " > /dev/full");
    EXPECT_EQ(result.code, 1) << arguments;
    EXPECT_THAT(result.err, EndsWith(kFull)) << arguments;
  }
  EXPECT_EQ(shell("clca check small.yaml > /dev/full").err, kFull);
}

TEST_F(OutputTest, WhatIsWrongKeepsItsExitCodeWhereNothingCanBePrinted) {
  EXPECT_EQ(shell("clca check none.yaml > /dev/full 2> /dev/full").code, 2);
  EXPECT_EQ(shell("clca fly 2> /dev/full").code, 2);
  EXPECT_EQ(shell("clca fly 2>&-").code, 2);
  EXPECT_EQ(shell("clca check small.yaml > /dev/full 2> /dev/full").code, 1);
  EXPECT_EQ(shell("clca run small.yaml 2> /dev/full").code, 0);
}

TEST_F(OutputTest, NoFileOfARunTakesThePlaceOfAClosedStream) {
  const auto result = shell("clca run small.yaml -o all");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(shell("clca run small.yaml -o none <&- >&- 2>&-").code, 1);
  EXPECT_EQ(shell("clca run small.yaml -o deaf 2>&-").code, 0);
  EXPECT_THAT(shell("clca run small.yaml -o mute >&-").err, EndsWith(kClosed));
  for (const std::string folder : {"none", "deaf", "mute"}) {
    EXPECT_EQ(text(folder + "/scene.yaml"), text("all/scene.yaml")) << folder;
    EXPECT_EQ(nlohmann::json::parse(text(folder + "/run.json"))["status"], "done") << folder;
    EXPECT_THAT(text(folder + "/log.txt"), Not(HasSubstr("particle-updates"))) << folder;
  }
}

TEST_F(OutputTest, AReaderThatHasHadEnoughIsNoError) {
  const std::string unread = "mkfifo pipe; exec 3<>pipe 4>pipe 3<&-; ";
  const auto result = shell(unread + "clca check small.yaml >&4");
  EXPECT_EQ(result.code, kSigPipe);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(shell("rm pipe; " + unread + "clca run small.yaml 2>&4").code, 0);
}

}  // namespace
}  // namespace clca::output_test
