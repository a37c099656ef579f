#include "clca/process/program.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include "support/runs.hpp"

namespace clca::process {
namespace {

std::string text(const Transcript& transcript) {
  const auto bytes = transcript.bytes();
  return {bytes.begin(), bytes.end()};
}

std::span<const std::uint8_t> bytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(ProgramTest, LeavesWhatItWritesAndItsExitCode) {
  const testing::ScratchFolder folder;
  const Transcript out;
  const Transcript err;
  Program program({"/bin/sh", "-c", "pwd; echo oh >&2; cat; exit 3"},
                  {.folder = folder.path(), .out = &out, .err = &err});
  EXPECT_EQ(program.wait(), 3);
  EXPECT_EQ(text(out), std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(text(err), "oh\n");
}

TEST(ProgramTest, ASignalThatEndsItIsTold) {
  EXPECT_EQ(Program({"/bin/sh", "-c", "kill -9 $$"}, {}).wait(), 128 + SIGKILL);
}

TEST(ProgramTest, ReadsAllThatItIsFedUntilTheEnd) {
  const Transcript out;
  Program program({"/usr/bin/wc", "-c"}, {.out = &out, .fed = true});
  const std::string much(1'000'000, 'x');
  EXPECT_TRUE(program.feed(bytes(much)));
  EXPECT_TRUE(program.feed(bytes("more")));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(text(out), "1000004\n");
}

TEST(ProgramTest, OneThatNoLongerReadsIsNoSignalButAnAnswer) {
  Program program({"/bin/sh", "-c", "exit 7"}, {.fed = true});
  const std::string much(10'000'000, 'x');
  EXPECT_FALSE(program.feed(bytes(much)));
  EXPECT_EQ(program.wait(), 7);
}

TEST(ProgramTest, OneThatIsFedIsOutOfReachOfTheTerminal) {
  const Transcript out;
  Program fed({"/bin/sh", "-c", "cut -d' ' -f5 /proc/$$/stat"}, {.out = &out, .fed = true});
  fed.wait();
  EXPECT_NE(std::stol(text(out)), ::getpgrp());
}

TEST(ProgramTest, OneThatIsGivenUpIsEnded) {
  const testing::ScratchFolder folder;
  const std::filesystem::path late = folder.path() / "late";
  { const Program program({"/bin/sh", "-c", "sleep 1; touch " + late.string()}, {}); }
  std::system("sleep 1.5");
  EXPECT_FALSE(std::filesystem::exists(late));
}

TEST(ProgramTest, OneThatCannotBeStartedIsAnError) {
  EXPECT_THROW(Program({"/nonexistent"}, {}), ProcessError);
  EXPECT_THROW(Program({"/nonexistent"}, {.fed = true}), ProcessError);
}

TEST(ProgramTest, IsFoundOnThePathOnly) {
  EXPECT_TRUE(find_program("sh"));
  EXPECT_FALSE(find_program("no-such-program"));
  EXPECT_FALSE(find_program("."));
}

}  // namespace
}  // namespace clca::process
