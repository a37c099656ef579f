// A run that is killed, or meets a full disk, at each call that changes a file: the folder holds
// the earlier run whole or goes on to the end of an unbroken one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <map>
#include <set>

#include "support/program.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::fault_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(clca: 1
box: {width: 24, height: 30}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [12, 0, 13, 30]}}
stages:
  - {name: packing, fill: {region: [0, 0, 12, 30], counts: {grain: 15}}, until: {steps: 8}}
  - {name: flow, remove: [gate], until: {steps: 8}}
output:
  frames: {every: 8, width: 64, height: 64, caption: false}
  series: {every: 1}
  trajectory: {every: 4}
  checkpoint: {every: 6}
)";

class Faults : public ::testing::Test {
 protected:
  Faults() {
    std::ofstream(path("scene.yaml")) << kScene;
    EXPECT_EQ(run("old", {"--seed", "1"}).code, 0);
    EXPECT_EQ(run("unbroken", {"--seed", "2"}).code, 0);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  testing::ProgramResult run(const std::string& out, std::vector<std::string> more,
                             std::map<std::string, std::string> environment = {}) const {
    more.insert(more.begin(), {"run", path("scene.yaml"), "-o", path(out), "--quiet"});
    return testing::run_program(more, {.environment = std::move(environment)});
  }
  testing::ProgramResult resume(std::map<std::string, std::string> environment = {}) const {
    return testing::run_program({"resume", path("out"), "--quiet"},
                                {.environment = std::move(environment)});
  }
  static std::map<std::string, std::string> fault(const char* what, int at) {
    return {{"LD_PRELOAD", CLCA_FAULT_INJECTION},
            {"CLCA_FAULT", what},
            {"CLCA_FAULT_AT", std::to_string(at)}};
  }

  /// The folder of the earlier run, and files of the user's in it.
  void lay_out_earlier_run() const {
    lay_out_nothing();
    fs::copy(path("old"), path("out"), fs::copy_options::recursive);
    for (const char* name : kMine) {
      std::ofstream(folder_.path() / "out" / name) << "mine";
    }
  }
  void lay_out_nothing() const { fs::remove_all(path("out")); }

  /// Empty where `out` is whole: the earlier run, or the new one.
  std::string difference() const {
    const fs::path out = path("out");
    for (const char* name : kMine) {
      if (fs::exists(out / "frames/mine.png") &&
          (!fs::exists(out / name) || fs::file_size(out / name) != 4)) {
        return std::string("lost ") + name;
      }
    }
    for (const char* name : kMine) {
      fs::remove(out / name);
    }
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      if (entry.path().filename().string().starts_with(".clca-")) {
        return "a temporary file is left: " + entry.path().string();
      }
    }
    const std::string from_new = testing::difference_of_runs(path("unbroken"), out);
    return from_new.empty() || testing::difference_of_runs(path("old"), out).empty() ? ""
                                                                                     : from_new;
  }

  static constexpr std::array kMine = {"frames/mine.png", "frames/other-000099.png", "lock",
                                       "book.part-2", "profile-me.csv"};
  testing::ScratchFolder folder_;
};

TEST_F(Faults, KilledAtAnyCallOverAnEarlierRunTheFolderIsWholeOrGoesOn) {
  for (int at = 1;; ++at) {
    SCOPED_TRACE(at);
    lay_out_earlier_run();
    const auto killed = run("out", {"--seed", "2"}, fault("kill", at));
    ASSERT_TRUE(killed.code == -SIGKILL || killed.code == 0) << killed.err;
    const auto resumed = resume();
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_EQ(difference(), "");
    if (killed.code == 0) {
      RecordProperty("calls", at);
      return;
    }
  }
}

TEST_F(Faults, KilledAtAnyCallInANewFolderTheRunGoesOnOrHasNotBegun) {
  for (int at = 1;; ++at) {
    SCOPED_TRACE(at);
    lay_out_nothing();
    const auto killed = run("out", {"--seed", "2"}, fault("kill", at));
    ASSERT_TRUE(killed.code == -SIGKILL || killed.code == 0) << killed.err;
    auto resumed = resume();
    if (resumed.code == 2) {
      EXPECT_THAT(resumed.err, ::testing::StartsWith("clca: error: cannot resume the run in"));
      resumed = run("out", {"--seed", "2"});
    }
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_EQ(difference(), "");
    if (killed.code == 0) {
      return;
    }
  }
}

TEST_F(Faults, KilledAtAnyCallWhileItGoesOnARunGoesOnAgain) {
  lay_out_earlier_run();
  int half = 1;
  while (run("out", {"--seed", "2", "--overwrite"}, fault("kill", half)).code == -SIGKILL) {
    half += 40;
  }
  for (int at = 1;; ++at) {
    SCOPED_TRACE(at);
    lay_out_earlier_run();
    ASSERT_EQ(run("out", {"--seed", "2"}, fault("kill", half / 2)).code, -SIGKILL);
    const auto killed = resume(fault("kill", at));
    ASSERT_TRUE(killed.code == -SIGKILL || killed.code == 0) << killed.err;
    const auto resumed = resume();
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_EQ(difference(), "");
    if (killed.code == 0) {
      return;
    }
  }
}

TEST_F(Faults, KilledWhileItBeginsAnewFromTheCheckpointBeforeARunGoesOnAgain) {
  const fs::path newest = folder_.path() / "out/checkpoint.clca";
  const fs::path before = folder_.path() / "out/checkpoint-previous.clca";
  int begun = 1;  // the call after which the first checkpoint has its name
  for (; !fs::exists(newest); ++begun) {
    lay_out_nothing();
    ASSERT_EQ(run("out", {"--seed", "2"}, fault("kill", begun)).code, -SIGKILL);
  }
  for (int at = 1;; ++at) {
    SCOPED_TRACE(at);
    lay_out_nothing();
    ASSERT_EQ(run("out", {"--seed", "2"}, fault("kill", begun)).code, -SIGKILL);
    ASSERT_FALSE(fs::exists(before));
    fs::rename(newest, before);
    std::ofstream(folder_.path() / "out/.clca.manifest", std::ios::app)
        << "file \"checkpoint-previous.clca\"\n";
    const auto killed = resume(fault("kill", at));
    ASSERT_TRUE(killed.code == -SIGKILL || killed.code == 0) << killed.err;
    const auto resumed = resume();
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_EQ(difference(), "");
    if (killed.code == 0) {
      return;
    }
  }
}

TEST_F(Faults, OnADiskThatIsFullFromAnyCallOnARunEndsWithOneLineAndGoesOn) {
#ifdef __clang__
  GTEST_SKIP() << "LLVM's OpenMP ends a program that gets no shared memory";
#endif
  for (int at = 1;; ++at) {
    SCOPED_TRACE(at);
    lay_out_earlier_run();
    const auto failed = run("out", {"--seed", "2"}, fault("full", at));
    if (failed.code == 0) {
      return;
    }
    ASSERT_EQ(failed.code, 1) << failed.err;
    ASSERT_THAT(failed.err, ::testing::MatchesRegex("clca: error: [^\n]*No space left[^\n]*\n"));
    const auto resumed = resume();
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    ASSERT_EQ(difference(), "");
  }
}

/// A file that gets its name.
struct Naming {
  std::string from;
  std::string to;
  std::set<std::string> not_flushed;  ///< files that are not on the disk then
};

std::vector<Naming> namings(const std::string& log) {
  std::vector<Naming> found;
  std::set<std::string> not_flushed;
  std::ifstream lines(log);
  for (std::string what, from, to; lines >> what >> from;) {
    if (what == "write") {
      not_flushed.insert(from);
    } else if (what == "flush") {
      not_flushed.erase(from);
    } else if (lines >> to) {
      found.push_back({from, to, not_flushed});
      if (not_flushed.erase(from) > 0) {
        not_flushed.insert(to);
      }
    }
  }
  return found;
}

/// The files that are not on the disk, each time `file` gets its name.
std::vector<std::set<std::string>> not_flushed_at(const fs::path& file, const std::string& log) {
  std::vector<std::set<std::string>> found;
  for (const Naming& naming : namings(log)) {
    if (naming.to == file.string()) {
      found.push_back(naming.not_flushed);
    }
  }
  return found;
}

TEST_F(Faults, WhatACheckpointOrADoneRunRefersToIsOnTheDiskBefore) {
  const std::string log = path("log");
  for (const char* more : {"output.checkpoint=none", "output.checkpoint={seconds: 60}"}) {
    SCOPED_TRACE(more);
    lay_out_nothing();
    fs::remove(log);
    ASSERT_EQ(
        run("out", {"--set", more}, {{"LD_PRELOAD", CLCA_FAULT_INJECTION}, {"CLCA_FAULT_LOG", log}})
            .code,
        0);
    const fs::path out = fs::canonical(path("out"));
    const auto at_checkpoints = not_flushed_at(out / "checkpoint.clca", log);
    ASSERT_EQ(at_checkpoints.size(), std::string(more).ends_with("none") ? 1 : 2);
    for (const auto& files : at_checkpoints) {
      EXPECT_THAT(files, ::testing::IsEmpty());
    }
    const auto at_summaries = not_flushed_at(out / "run.json", log);
    ASSERT_EQ(at_summaries.size(), 2);
    EXPECT_THAT(at_summaries.front(), ::testing::Not(::testing::IsEmpty())) << "not yet done";
    EXPECT_THAT(at_summaries.back(), ::testing::IsEmpty());
  }
}

TEST_F(Faults, WhatACommandWritesIsOnTheDiskBeforeItReplacesWhatWasThere) {
  const std::string log = path("log");
  const std::vector<std::vector<std::string>> commands = {
      {"export", path("unbroken"), "--format", "xyz", "-o", path("grains.xyz")},
      {"render", path("unbroken"), "-o", path("pictures")},
      {"plot", path("unbroken"), "-o", path("figures")},
      {"report", path("unbroken")},
  };
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(command.front());
    fs::remove(log);
    const auto result = testing::run_program(
        command, {.environment = {{"LD_PRELOAD", CLCA_FAULT_INJECTION}, {"CLCA_FAULT_LOG", log}}});
    ASSERT_EQ(result.code, 0) << result.err;
    const std::vector<Naming> all = namings(log);
    EXPECT_GE(all.size(), 1U);
    for (const Naming& naming : all) {
      EXPECT_FALSE(naming.not_flushed.contains(naming.from)) << naming.to;
    }
  }
}

}  // namespace
}  // namespace clca::fault_test
