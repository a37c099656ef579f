// Only what clca wrote itself is replaced or removed, and nothing outside of the folder.

#include "clca/store/output_folder.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <latch>
#include <optional>
#include <thread>

#include "clca/store/file.hpp"
#include "clca/store/growing_file.hpp"
#include "support/runs.hpp"

namespace clca::store::output_folder_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class OutputFolderTest : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return scratch_.path() / name; }
  OutputFolder folder() const { return OutputFolder(path("out")); }
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(path(name).parent_path());
    std::ofstream(path(name)) << text;
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(path(name));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// Names in a folder, but for the manifest.
  std::vector<std::string> names(const std::string& below) const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(path(below))) {
      if (entry.path().filename() != ".clca.manifest") {
        result.push_back(entry.path().filename().string());
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  testing::ScratchFolder scratch_;
};

TEST_F(OutputFolderTest, AFileIsThereWhenItIsFinishedAndNothingIsLeftOfOneThatIsNot) {
  {
    AtomicFile file = folder().create("a.txt");
    file.write("first, ");
    file.write("second");
    file.write(" and third");
    EXPECT_EQ(file.size(), 23U);
    EXPECT_FALSE(fs::exists(path("out/a.txt")));
    file.finish();
  }
  EXPECT_EQ(text("out/a.txt"), "first, second and third");
  { folder().create("a.txt").write("lost"); }
  EXPECT_EQ(text("out/a.txt"), "first, second and third");
  EXPECT_THAT(names("out"), ElementsAre("a.txt"));
}

TEST_F(OutputFolderTest, ItsOwnFileIsReplacedAlsoByAnotherProcess) {
  folder().write("a.txt", "first");
  folder().write("a.txt", "second");
  EXPECT_EQ(text("out/a.txt"), "second");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt"));
}

TEST_F(OutputFolderTest, AFileThatItDidNotWriteIsNeitherReplacedNorAddedToNorRemoved) {
  put("out/a.txt", "mine");
  const OutputFolder out = folder();
  const auto refusal =
      ThrowsMessage<StoreError>(HasSubstr("clca did not write the file that is there"));
  EXPECT_THAT([&] { out.write("a.txt", "x"); }, refusal);
  EXPECT_THAT([&] { out.require_free("a.txt"); }, refusal);
  EXPECT_THAT([&] { out.open_to_append("a.txt"); }, refusal);
  EXPECT_THAT([&] { GrowingFile(out, "a.txt", 0); }, refusal);
  EXPECT_THAT([&] { GrowingFile(out, "a.txt", 2); }, refusal);
  out.remove("a.txt");
  out.clear("a.txt", "");
  EXPECT_EQ(text("out/a.txt"), "mine");
}

TEST_F(OutputFolderTest, AFileThatComesWhileItsNamesakeIsWrittenStays) {
  AtomicFile file = folder().create("a.txt");
  file.write("x");
  put("out/a.txt", "mine");
  EXPECT_THAT([&] { file.finish(); }, ThrowsMessage<StoreError>(HasSubstr("clca did not write")));
  EXPECT_EQ(text("out/a.txt"), "mine");
}

TEST_F(OutputFolderTest, ClearRemovesWhatTheManifestListsAndNothingElse) {
  const OutputFolder out = folder();
  for (const char* name :
       {"run.json", "kept", "frames/a-000001.png", "frames/deep/b.csv", "c.csv"}) {
    out.write(name, "x");
  }
  put("out/frames/mine.png", "mine");
  put("out/notes.txt", "mine");
  put("out/plots/mine.png", "mine");
  out.clear("run.json", "kept");
  EXPECT_THAT(names("out"), ElementsAre("frames", "kept", "notes.txt", "plots"));
  EXPECT_THAT(names("out/frames"), ElementsAre("mine.png"));
  EXPECT_THAT(folder().files(), ElementsAre("kept"));
  put("out/c.csv", "mine now");
  folder().clear("run.json", "kept");
  EXPECT_EQ(text("out/c.csv"), "mine now") << "a name that is listed no more";
}

TEST_F(OutputFolderTest, SymbolicLinksAreNeverFollowed) {
  const OutputFolder out = folder();
  out.write("frames/a.png", "x");
  out.write("table.csv", "x");
  put("far/a.png", "mine");
  fs::remove_all(path("out/frames"));
  fs::create_directory_symlink(path("far"), path("out/frames"));
  fs::remove(path("out/table.csv"));
  fs::create_symlink(path("far/a.png"), path("out/table.csv"));
  EXPECT_THAT([&] { out.write("frames/a.png", "y"); },
              ThrowsMessage<StoreError>(HasSubstr("link")));
  EXPECT_THAT([&] { out.write("table.csv", "y"); },
              ThrowsMessage<StoreError>(EndsWith("it is not a regular file")));
  EXPECT_THROW(out.open_to_append("table.csv"), StoreError);
  EXPECT_THROW(out.truncate("table.csv", 0), StoreError);
  out.clear("", "");
  EXPECT_EQ(text("far/a.png"), "mine");
  EXPECT_TRUE(fs::is_symlink(path("out/table.csv")));
}

TEST_F(OutputFolderTest, AManifestThatNamesFilesElsewhereOrIsNoneIsRefused) {
  put("a.txt", "mine");
  for (const char* manifest :
       {"clca manifest 1\nfile \"../a.txt\"\n", "clca manifest 1\nfile \"/a.txt\"\n",
        "clca manifest 1\nfile \"b/../../a.txt\"\n", "clca manifest 1\nfolder \"..\"\n",
        "something else\n", "clca manifest 2\n"}) {
    put("out/.clca.manifest", manifest);
    EXPECT_THROW(folder(), StoreError) << manifest;
  }
  fs::remove(path("out/.clca.manifest"));
  fs::create_symlink(path("a.txt"), path("out/.clca.manifest"));
  EXPECT_THROW(folder(), StoreError);
  EXPECT_EQ(text("a.txt"), "mine");
}

TEST_F(OutputFolderTest, ALineOfTheManifestThatWasNotWrittenWholeIsPassedOver) {
  folder().write("a.txt", "x");
  std::ofstream(path("out/.clca.manifest"), std::ios::app) << "file \"b.t";
  put("out/b.t", "mine");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt"));
  folder().write("c.txt", "x");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt", "c.txt"));
}

TEST_F(OutputFolderTest, NamesThatLeaveTheFolderAreRefused) {
  for (const char* name : {"../a", "/a", "", ".", "..", "b/../../a", "b//a", "a\nb"}) {
    EXPECT_THROW(folder().write(name, "x"), StoreError) << name;
  }
}

TEST_F(OutputFolderTest, TemporaryFilesOfAKilledProcessAreRemovedAndNoOthers) {
  folder().write("frames/a.png", "x");
  const pid_t child = ::fork();
  if (child == 0) {
    const AtomicFile file = folder().create("frames/b.png");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(names("out/frames").size(), 2U);
  put("out/frames/.clca-0123456789abcdef-1", "mine");
  put("out/frames/book.part-2", "mine");
  const AtomicFile at_work = folder().create("frames/c.png");
  folder().write("d.txt", "x");
  EXPECT_THAT(names("out/frames"),
              ::testing::UnorderedElementsAre(at_work.temporary_path().filename().string(),
                                              ".clca-0123456789abcdef-1", "a.png", "book.part-2"));
}

TEST_F(OutputFolderTest, AFileThatTheUserNamedReplacesARegularFileAndIsNotListed) {
  put("out/a.txt", "mine");
  write_whole(path("out/a.txt"), "asked for");
  EXPECT_EQ(text("out/a.txt"), "asked for");
  EXPECT_FALSE(fs::exists(path("out/.clca.manifest")));
  folder().clear("", "");
  EXPECT_EQ(text("out/a.txt"), "asked for");
  ASSERT_EQ(::mkfifo(path("out/pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_whole(path("out/pipe"), "x"), StoreError);
  EXPECT_TRUE(fs::is_fifo(path("out/pipe")));
}

TEST_F(OutputFolderTest, AManifestOfSomebodyElseIsNoObstacleToAFileThatTheUserNamed) {
  put("out/.clca.manifest", "something else\n");
  write_whole(path("out/a.txt"), "asked for");
  EXPECT_EQ(text("out/a.txt"), "asked for");
  EXPECT_EQ(text("out/.clca.manifest"), "something else\n");
}

TEST_F(OutputFolderTest, AFileWhoseNameWasTakenMeanwhileIsNotListed) {
  {
    AtomicFile file = folder().create("a.txt");
    put("out/a.txt", "mine");
    EXPECT_THROW(file.finish(), StoreError);
  }
  EXPECT_THROW(folder().write("a.txt", "x"), StoreError);
  folder().clear("", "");
  EXPECT_EQ(text("out/a.txt"), "mine");
}

TEST_F(OutputFolderTest, AFileThatWasRemovedIsTheUsersToMakeAnew) {
  folder().write("a.txt", "x");
  folder().remove("a.txt");
  put("out/a.txt", "mine");
  EXPECT_THROW(folder().write("a.txt", "x"), StoreError);
  folder().clear("", "");
  EXPECT_EQ(text("out/a.txt"), "mine");
}

TEST_F(OutputFolderTest, ABackupByHardLinksIsNotChanged) {
  const OutputFolder out = folder();
  GrowingFile(out, "table.csv", 0).append("a,b\n1,2\n");
  fs::create_directories(path("backup"));
  for (const char* name : {"table.csv", ".clca.manifest"}) {
    fs::create_hard_link(path("out") / name, path("backup") / name);
  }
  const std::string manifest = text("backup/.clca.manifest");
  GrowingFile(folder(), "table.csv", 8).append("3,4\n");
  folder().write("more.txt", "x");
  EXPECT_EQ(text("out/table.csv"), "a,b\n1,2\n3,4\n");
  EXPECT_EQ(text("backup/table.csv"), "a,b\n1,2\n");
  EXPECT_EQ(text("backup/.clca.manifest"), manifest);
}

TEST_F(OutputFolderTest, WhatAnotherProcessListsWhileTheFolderIsClearedStaysListed) {
  const OutputFolder out = folder();
  out.write("a.txt", "x");
  folder().write("b.txt", "x");  // out does not know of it
  out.clear("", "a.txt");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt"));
  AtomicFile late = folder().create("c.txt");
  out.clear("", "a.txt");
  late.finish();
  EXPECT_THAT(folder().files(), ElementsAre("a.txt", "c.txt"));
}

TEST_F(OutputFolderTest, AFileThatAnotherProcessRemovedMeanwhileIsListedAgainWhenItIsReplaced) {
  folder().write("plots/figure.png", "one");
  const OutputFolder plot = folder();
  AtomicFile figure = plot.create("plots/figure.png");
  folder().clear("", "");
  figure.write(std::string_view("two"));
  figure.finish();
  EXPECT_EQ(text("out/plots/figure.png"), "two");
  EXPECT_TRUE(folder().owns("plots/figure.png"));
  EXPECT_NO_THROW(folder().write("plots/figure.png", "three"));
  folder().clear("", "");
  EXPECT_THAT(names("out"), ElementsAre());
}

TEST_F(OutputFolderTest, AFileThatAnotherProcessMadeAgainWhileTheFolderIsClearedStaysListed) {
  folder().write("figure.png", "one");
  const OutputFolder run = folder();
  run.write("first", "");
  // Between the removal of the files and that of their names.
  const int held = ::open(path("out/.clca.manifest").c_str(), O_RDONLY);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  std::thread clearing([&] { run.clear("first", ""); });
  while (fs::exists(path("out/figure.png"))) {
    std::this_thread::yield();
  }
  put("out/figure.png", "two");  // as one that has listed it does
  ::close(held);
  clearing.join();
  EXPECT_TRUE(folder().owns("figure.png"));
  EXPECT_FALSE(folder().owns("first"));
}

TEST_F(OutputFolderTest, AManifestThatIsGoneIsNotBegunAnew) {
  const OutputFolder out = folder();
  out.write("a.txt", "x");
  fs::remove(path("out/.clca.manifest"));
  EXPECT_THAT([&] { out.write("b.txt", "x"); },
              ThrowsMessage<StoreError>(HasSubstr("it has been removed or emptied meanwhile")));
}

TEST_F(OutputFolderTest, AManifestWithPartOfItsHeaderIsWrittenAnew) {
  put("out/.clca.manifest", "clca man");
  folder().write("a.txt", "x");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt"));
}

TEST_F(OutputFolderTest, FilesOfItsOwnCannotBeNamedByTheUser) {
  folder().write("a.txt", "x");
  EXPECT_THROW(write_whole(path("out/.clca.manifest"), "x"), StoreError);
  EXPECT_THAT(folder().files(), ElementsAre("a.txt"));
}

TEST_F(OutputFolderTest, AGrowingFileKeepsWhatItIsToldAndCutsOffTheRest) {
  const OutputFolder out = folder();
  GrowingFile file(out, "table.csv", 0);
  EXPECT_FALSE(fs::exists(path("out/table.csv")));
  file.append("a,b\n");
  file.append("");
  file.append("1,2\n");
  EXPECT_EQ(file.bytes(), 8U);
  GrowingFile again(out, "table.csv", 4);
  again.append("3,4\n");
  out.flush();
  EXPECT_EQ(text("out/table.csv"), "a,b\n3,4\n");
  EXPECT_THAT(
      [&] { GrowingFile(out, "table.csv", 9); },
      ThrowsMessage<StoreError>(EndsWith("it is shorter than when the checkpoint was made")));
  GrowingFile anew(out, "table.csv", 0);
  EXPECT_FALSE(fs::exists(path("out/table.csv")));
  out.flush();
}

TEST_F(OutputFolderTest, PlannedFilesAreListedAtOnceAndAreItsOwnOnlyWhenItHasWrittenThem) {
  const auto refusal =
      ThrowsMessage<StoreError>(HasSubstr("clca did not write the file that is there"));
  {
    const OutputFolder out = folder();
    out.write("old.txt", "x");
    out.plan({"a.txt", "b.txt", "c.txt", "old.txt"});
    EXPECT_THAT(text("out/.clca.manifest"), HasSubstr("file \"a.txt\"\nfile \"b.txt\"\n"));
    const std::string manifest = text("out/.clca.manifest");
    out.write("a.txt", "x");
    EXPECT_EQ(text("out/.clca.manifest"), manifest) << "it has been listed";
    put("out/b.txt", "mine");
    EXPECT_FALSE(out.owns("b.txt"));
    EXPECT_THAT([&] { out.write("b.txt", "x"); }, refusal);
    EXPECT_THAT([&] { out.open_to_append("b.txt"); }, refusal);
    out.clear("", "a.txt");
    EXPECT_THAT(names("out"), ElementsAre("a.txt", "b.txt"));
    EXPECT_THAT(text("out/.clca.manifest"), HasSubstr("file \"c.txt\""));
    EXPECT_THAT(text("out/.clca.manifest"), HasSubstr("file \"old.txt\""));
    out.write("old.txt", "y");
  }
  put("out/c.txt", "mine");
  EXPECT_THAT(folder().files(), ElementsAre("a.txt", "old.txt")) << "the rest was not written";
  EXPECT_THAT([&] { folder().write("c.txt", "x"); }, refusal);
}

TEST_F(OutputFolderTest, AFileThatComesWhileAPlannedOneIsWrittenStaysAndIsNotListed) {
  {
    const OutputFolder out = folder();
    out.plan({"a.txt"});
    AtomicFile file = out.create("a.txt");
    put("out/a.txt", "mine");
    EXPECT_THROW(file.finish(), StoreError);
  }
  folder().clear("", "");
  EXPECT_EQ(text("out/a.txt"), "mine");
}

TEST_F(OutputFolderTest, AFileThatIsGoneBeforeItIsFlushedIsNoError) {
  const OutputFolder out = folder();
  out.delay_flushing();
  out.write("frames/a.png", "x");
  out.write("b.txt", "x");
  fs::remove_all(path("out/frames"));
  out.flush();
  EXPECT_EQ(text("out/b.txt"), "x");
}

TEST_F(OutputFolderTest, SeveralThatWriteAtOnceKeepTheTemporaryFilesOfEachOther) {
  constexpr int kFiles = 300;
  const auto write = [&](char first) {
    for (int i = 0; i < kFiles; ++i) {
      EXPECT_NO_THROW(folder().write(first + std::to_string(i), "x"));
    }
  };
  std::thread other([&] { write('b'); });
  write('a');
  other.join();
  EXPECT_EQ(folder().files().size(), 2 * kFiles);
}

TEST_F(OutputFolderTest, OfTwoThatWriteAFileAtOnceTheLaterOneReplacesItAndItStaysListed) {
  AtomicFile first = folder().create("a.txt");
  AtomicFile second = folder().create("a.txt");
  first.write("first");
  second.write("second");
  first.finish();
  second.finish();
  EXPECT_EQ(text("out/a.txt"), "second");
  folder().write("a.txt", "third");
  EXPECT_EQ(text("out/a.txt"), "third");
}

TEST_F(OutputFolderTest, SeveralThatBeginAFileAtOnceLeaveItListed) {
  constexpr int kRounds = 100;
  constexpr int kAtOnce = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::string name = "a" + std::to_string(round);
    std::latch begin(kAtOnce);
    std::vector<std::thread> threads;
    for (int i = 0; i < kAtOnce; ++i) {
      threads.emplace_back([&, i] {
        const OutputFolder out = folder();
        begin.arrive_and_wait();
        if ((round + i) % 2 == 0) {
          EXPECT_NO_THROW(out.write(name, "x"));
        } else {
          EXPECT_NO_THROW(::close(out.open_to_append(name)));
        }
      });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
    EXPECT_NO_THROW(folder().write(name, "y")) << name;
  }
}

TEST_F(OutputFolderTest, WhereAFolderIsRemovedMeanwhileOneLineSaysSo) {
  const OutputFolder out = folder();
  out.write("a.txt", "x");
  fs::remove_all(path("out"));
  EXPECT_THAT([&] { out.write("b.txt", "x"); },
              ThrowsMessage<StoreError>(EndsWith("No such file or directory")));
}

}  // namespace
}  // namespace clca::store::output_folder_test
