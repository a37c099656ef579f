#include "clca/process/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include "support/runs.hpp"

namespace clca::process::program_test {
namespace {

std::string text(const OutputCapture& transcript) {
  const auto bytes = transcript.bytes();
  return {bytes.begin(), bytes.end()};
}

std::span<const std::uint8_t> bytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(ProgramTest, LeavesWhatItWritesAndItsExitCode) {
  const testing::ScratchFolder folder;
  const OutputCapture out;
  const OutputCapture err;
  Program program({"/bin/sh", "-c", "pwd; echo oh >&2; cat; exit 3"},
                  {.working_folder = folder.path(), .output = &out, .error_output = &err});
  EXPECT_EQ(program.wait(), 3);
  EXPECT_EQ(text(out), std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(text(err), "oh\n");
}

TEST(ProgramTest, ASignalThatEndsItIsTold) {
  EXPECT_EQ(Program({"/bin/sh", "-c", "kill -9 $$"}, {}).wait(), 128 + SIGKILL);
}

TEST(ProgramTest, ReadsAllThatItIsFedUntilTheEnd) {
  const OutputCapture out;
  Program program({"/usr/bin/wc", "-c"}, {.output = &out, .is_fed = true});
  const std::string much(1'000'000, 'x');
  EXPECT_TRUE(program.feed(bytes(much)));
  EXPECT_TRUE(program.feed(bytes("more")));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(text(out), "1000004\n");
}

TEST(ProgramTest, OneThatNoLongerReadsIsNoSignalButAnAnswer) {
  Program program({"/bin/sh", "-c", "exit 7"}, {.is_fed = true});
  const std::string much(10'000'000, 'x');
  EXPECT_FALSE(program.feed(bytes(much)));
  EXPECT_EQ(program.wait(), 7);
}

TEST(ProgramTest, OneThatIsFedIsOutOfReachOfTheTerminal) {
  const OutputCapture out;
  Program fed({"/bin/sh", "-c", "cut -d' ' -f5 /proc/$$/stat"}, {.output = &out, .is_fed = true});
  fed.wait();
  EXPECT_NE(std::stol(text(out)), ::getpgrp());
}

TEST(ProgramTest, OneThatIsGivenUpIsEnded) {
  const testing::ScratchFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  int from = -1;
  {
    const Program program({"/bin/sh", "-c", "exec sleep 1000 > " + pipe}, {});
    from = ::open(pipe.c_str(), O_RDONLY);  // returns once the program has opened it, too
  }
  // The pipe hangs up when the last program that writes to it has ended.
  constexpr int kLimit = 120'000;  // milliseconds
  pollfd end = {.fd = from, .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&end, 1, kLimit), 1);
  EXPECT_EQ(end.revents, POLLHUP);
  ::close(from);
}

TEST(ProgramTest, OneThatCannotBeStartedIsAnError) {
  const testing::ScratchFolder folder;
  const std::string missing = folder.path() / "missing";
  EXPECT_THROW(Program({missing}, {}), ProcessError);
  EXPECT_THROW(Program({missing}, {.is_fed = true}), ProcessError);
}

TEST(ProgramTest, OneInAFolderThatIsNotThereNamesTheFolder) {
  const testing::ScratchFolder folder;
  const std::string missing = folder.path() / "missing";
  try {
    Program({"/bin/sh", "-c", "true"}, {.working_folder = missing});
    FAIL();
  } catch (const ProcessError& error) {
    EXPECT_EQ(error.what(), "cannot enter the folder " + missing + ": No such file or directory");
  }
}

TEST(ProgramTest, OneThatHangsIsEndedOnceItIsToStop) {
  std::atomic<int> stop = 0;
  Program waits({"/bin/sleep", "1000"}, {.stop = &stop});
  Program takes_nothing({"/bin/sleep", "1000"}, {.is_fed = true, .stop = &stop});
  stop = SIGINT;
  EXPECT_THROW(waits.wait(), StoppedError);
  const std::string much(10'000'000, 'x');
  EXPECT_THROW(takes_nothing.feed(bytes(much)), StoppedError);
}

TEST(ProgramTest, OneThatComesToItsEndInTimeIsDone) {
  const std::atomic<int> stop = SIGINT;
  const OutputCapture out;
  Program program(
      {"/usr/bin/wc", "-c"},
      {.output = &out, .is_fed = true, .stop = &stop, .grace_period = std::chrono::minutes(1)});
  const std::string much(1'000'000, 'x');
  EXPECT_TRUE(program.feed(bytes(much)));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(text(out), "1000000\n");
}

TEST(ProgramTest, OneInheritsNoFilesButItsStreams) {
  const testing::ScratchFolder folder;
  const int open = ::open((folder.path() / "file").c_str(), O_WRONLY | O_CREAT, 0600);
  const Program other({"/bin/sleep", "1000"}, {.is_fed = true});
  const OutputCapture out;
  Program program({"/bin/ls", "/proc/self/fd"}, {.output = &out});
  EXPECT_EQ(program.wait(), 0);
  EXPECT_EQ(text(out), "0\n1\n2\n3\n");  // 3 is the folder that ls reads
  ::close(open);
}

TEST(ProgramTest, OneEndsWithTheProgramThatStartedItHoweverThatEnds) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t starter = ::fork();
  if (starter == 0) {
    Program program({"/bin/sh", "-c", "kill -KILL $PPID; exec sleep 1000"}, {});
    program.wait();
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(starter, &status, 0), starter);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  EXPECT_GT(::waitpid(-1, &status, 0), 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST(ProgramTest, IsFoundOnThePathOnly) {
  EXPECT_TRUE(find_program("sh"));
  EXPECT_FALSE(find_program("no-such-program"));
  EXPECT_FALSE(find_program("."));
}

}  // namespace
}  // namespace clca::process::program_test
