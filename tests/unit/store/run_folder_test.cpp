#include "clca/store/run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>

#include "clca/store/file.hpp"
#include "support/runs.hpp"

namespace clca::store::run_folder_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class RunFolderTest : public ::testing::Test {
 protected:
  fs::path run() const { return scratch_.path() / "run"; }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories((run() / name).parent_path());
    std::ofstream(run() / name) << text;
  }
  static Checkpoint start() {
    RunSummary summary;
    summary.scene = "new";
    summary.status = "running";
    return {.kind = "automaton",
            .scene_name = "new",
            .scene_text = "clca: 1\n",
            .summary_json = to_json(summary),
            .fields = {}};
  }
  /// A run that has saved itself once.
  void leave_run(const std::string& status) const {
    const RunFolder folder = RunFolder::for_new_run(run());
    folder.start_over(start());
    Checkpoint saved = start();
    saved.fields["state/step"] = std::vector<std::uint64_t>{5};
    write_checkpoint(folder.output_folder(), saved);
    RunSummary summary;
    summary.scene = "old";
    summary.seed = 7;
    summary.status = status;
    folder.output_folder().write(kSummaryFile, to_json(summary));
  }

  testing::ScratchFolder scratch_;
};

TEST_F(RunFolderTest, StartingOverRemovesWhatTheEarlierRunLeftAndNothingElse) {
  leave_run("done");
  {
    const OutputFolder files(run());
    for (const char* name : {"series.csv", "profile-flow.csv", "frames/old-000120.png",
                             "plots/series.png", "export/old.gsd", "report.html"}) {
      files.write(name, "x");
    }
  }
  for (const char* name : {"profile-me.csv", "plots/mine.png", "frames/mine-000120.png", "lock",
                           "book.part-2", "notes.txt"}) {
    put(name, "mine");
  }
  const RunFolder folder = RunFolder::for_new_run(run());
  EXPECT_EQ(folder.earlier_run()->summary.seed, 7U);
  EXPECT_FALSE(folder.earlier_run()->is_resumable);
  folder.start_over(start());
  for (const char* name : {"run.json", "series.csv", "profile-flow.csv", "frames/old-000120.png",
                           "plots/series.png", "export", "report.html", kPreviousCheckpointFile}) {
    EXPECT_FALSE(fs::exists(run() / name)) << name;
  }
  for (const char* name : {"profile-me.csv", "plots/mine.png", "frames/mine-000120.png", "lock",
                           "book.part-2", "notes.txt", kCheckpointFile}) {
    EXPECT_TRUE(fs::exists(run() / name)) << name;
  }
  EXPECT_TRUE(read_checkpoint(run(), 1e9)->checkpoint.is_before_first_step());
}

TEST_F(RunFolderTest, KnowsARunThatCanGoOn) {
  leave_run("interrupted");
  EXPECT_TRUE(RunFolder::for_new_run(run()).earlier_run()->is_resumable);
  RunFolder::for_new_run(run()).start_over(start());
  EXPECT_FALSE(RunFolder::for_new_run(run()).earlier_run()->is_resumable);
  EXPECT_EQ(RunFolder::for_new_run(run()).earlier_run()->summary.scene, "new");
}

TEST_F(RunFolderTest, RefusesAFolderOfSomethingElse) {
  put("notes.txt", "mine");
  EXPECT_THAT([&] { RunFolder::for_new_run(run()); },
              ThrowsMessage<StoreError>(HasSubstr("clca did not make the folder")));
  fs::remove(run() / "notes.txt");
  EXPECT_EQ(std::distance(fs::directory_iterator(run()), {}), 0);
  OutputFolder(run()).write("runs.csv", "x");
  EXPECT_THAT([&] { RunFolder::for_new_run(run()); },
              ThrowsMessage<StoreError>(HasSubstr("something else than a run there (runs.csv)")));
}

TEST_F(RunFolderTest, WhereNoRunHasBegunNothingIsMadeToGoOn) {
  EXPECT_THAT([&] { RunFolder::for_resumed_run(run()); },
              ThrowsMessage<StoreError>(EndsWith("there is no such folder")));
  put("run.json", "{}");
  put(kCheckpointFile, "x");
  EXPECT_THAT([&] { RunFolder::for_resumed_run(run()); },
              ThrowsMessage<StoreError>(
                  EndsWith("no run has begun there, or it has lost its .clca.manifest")));
  EXPECT_EQ(std::distance(fs::directory_iterator(run()), {}), 2);
}

TEST_F(RunFolderTest, KeepsFramesUpToAStepWhenARunGoesOn) {
  const RunFolder folder = RunFolder::for_new_run(run());
  const auto frame = [](std::uint64_t step) {
    return std::string(kFramesFolder) + "/" + frame_name("scene", step, 6);
  };
  for (const std::uint64_t step : {10U, 20U, 1'000'000U}) {
    folder.output_folder().write(frame(step), "x");
  }
  put("frames/scene-000030.png", "mine");
  folder.remove_frames_after(10);
  EXPECT_TRUE(fs::exists(run() / frame(10)));
  EXPECT_FALSE(fs::exists(run() / frame(20)));
  EXPECT_FALSE(fs::exists(run() / frame(1'000'000)));
  folder.remove_frames_after(std::nullopt);
  EXPECT_FALSE(fs::exists(run() / frame(10)));
  EXPECT_TRUE(fs::exists(run() / "frames/scene-000030.png"));
}

TEST_F(RunFolderTest, IsOfOneRunAtATime) {
  leave_run("done");
  std::optional<RunFolder> first(RunFolder::for_new_run(run()));
  EXPECT_THAT([&] { RunFolder::for_resumed_run(run()); },
              ThrowsMessage<StoreError>(HasSubstr("run: another run is at work in it")));
  const RunFolder moved = std::move(*first);
  first.reset();
  EXPECT_THROW(RunFolder::for_new_run(run()), StoreError);
  EXPECT_NO_THROW(RunFolder::for_new_run(scratch_.path() / "other"));
}

TEST_F(RunFolderTest, TheLockIsNeitherFollowedNorEmptied) {
  put("../mine.txt", "mine");
  fs::create_directories(run());
  fs::create_symlink(scratch_.path() / "mine.txt", run() / ".clca.lock");
  EXPECT_THROW(RunFolder::for_new_run(run()), StoreError);
  fs::remove(run() / ".clca.lock");
  put(".clca.lock", "mine");
  { const RunFolder folder = RunFolder::for_new_run(run()); }
  const auto bytes = read_whole_file(run() / ".clca.lock", 100);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "mine");
}

TEST_F(RunFolderTest, SaysWhyAFolderCannotBeMade) {
  std::ofstream(scratch_.path() / "file") << "x";
  EXPECT_THAT([&] { RunFolder::for_new_run(scratch_.path() / "file"); },
              ThrowsMessage<StoreError>(HasSubstr("Not a directory")));
}

}  // namespace
}  // namespace clca::store::run_folder_test
