// Files appear whole; only what clca has written is removed, and nothing outside of its folder.

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
  EXPECT_THAT(folder().listed_files(), ElementsAre("a.txt"));
}

TEST_F(OutputFolderTest, AFolderIsItsOwnIfItMadeItOrItIsEmpty) {
  EXPECT_NO_THROW(folder().require_clca_folder()) << "there is none";
  fs::create_directories(path("out"));
  EXPECT_NO_THROW(folder().require_clca_folder());
  put("out/.clca.lock", "");
  EXPECT_NO_THROW(folder().require_clca_folder());
  put("out/mine.txt", "mine");
  EXPECT_THAT([&] { folder().require_clca_folder(); },
              ThrowsMessage<StoreError>(
                  EndsWith("out: clca did not make the folder, and there are files in it "
                           "(mine.txt); write elsewhere")));
  EXPECT_THROW(named_folder(path("out"), "", ""), StoreError);
  fs::remove(path("out/mine.txt"));
  folder().write("a.txt", "x");
  put("out/mine.txt", "mine");
  EXPECT_NO_THROW(folder().require_clca_folder());
  EXPECT_NO_THROW(named_folder(path("out"), "", ""));
  folder().make_clca_folder();
  EXPECT_EQ(text("out/.clca.manifest"), "clca manifest 1\n\nfile \"a.txt\"\n");
  put("file", "mine");
  EXPECT_THROW(OutputFolder(path("file")).require_clca_folder(), StoreError);
}

TEST_F(OutputFolderTest, ClearRemovesWhatTheManifestListsAndNothingElse) {
  const OutputFolder out = folder();
  for (const char* name : {"run.json", "kept", "frames/a-000001.png", "frames/deep/b.csv"}) {
    out.write(name, "x");
  }
  folder().write("c.csv", "x");  // as another process does
  put("out/frames/mine.png", "mine");
  put("out/notes.txt", "mine");
  put("out/plots/mine.png", "mine");
  out.clear("run.json", "kept");
  EXPECT_THAT(names("out"), ElementsAre("frames", "kept", "notes.txt", "plots"));
  EXPECT_THAT(names("out/frames"), ElementsAre("mine.png"));
  EXPECT_THAT(folder().listed_files(), ElementsAre("kept"));
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
  EXPECT_THROW(GrowingFile(out, "table.csv", 0).append("y"), StoreError);
  EXPECT_THROW(GrowingFile(out, "table.csv", 1), StoreError);
  out.write("kept.csv", "x");
  EXPECT_THAT([&] { out.clear("", ""); }, ThrowsMessage<StoreError>(HasSubstr("link")));
  EXPECT_EQ(text("out/kept.csv"), "x") << "nothing is lost where the next run cannot write";
  EXPECT_EQ(text("far/a.png"), "mine");
  EXPECT_TRUE(fs::is_symlink(path("out/table.csv")));
}

TEST_F(OutputFolderTest, AGrowingFileReplacesOneThatSomebodyElsePutThere) {
  const OutputFolder out = folder();
  out.write("a.txt", "x");
  put("out/table.csv", "mine");
  GrowingFile file(out, "table.csv", 0);
  file.append("a,b\n");
  file.append("1,2\n");
  EXPECT_EQ(text("out/table.csv"), "a,b\n1,2\n");
  out.flush();
}

TEST_F(OutputFolderTest, ALockIsFreeWhenItsOwnerIsDoneAlsoIfAChildWasForked) {
  std::optional<FolderLock> lock(std::in_place, path("."));
  const pid_t ends = ::fork();
  if (ends == 0) {
    lock.reset();
    ::_exit(0);
  }
  ::waitpid(ends, nullptr, 0);
  EXPECT_THROW(FolderLock{path(".")}, FolderInUseError) << "a child does not unlock it";
  const pid_t stays = ::fork();
  if (stays == 0) {
    ::pause();
    ::_exit(0);
  }
  lock.reset();
  EXPECT_NO_THROW(FolderLock{path(".")});
  ::kill(stays, SIGKILL);
  ::waitpid(stays, nullptr, 0);
}

TEST_F(OutputFolderTest, AManifestThatNamesFilesElsewhereOrIsNoneIsRefused) {
  put("a.txt", "mine");
  for (const char* manifest :
       {"clca manifest 1\nfile \"../a.txt\"\n", "clca manifest 1\nfile \"/a.txt\"\n",
        "clca manifest 1\nfile \"b/../../a.txt\"\n", "something else\n", "clca manifest 2\n"}) {
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
  EXPECT_THAT(folder().listed_files(), ElementsAre("a.txt"));
  folder().write("c.txt", "x");
  EXPECT_THAT(folder().listed_files(), ElementsAre("a.txt", "c.txt"));
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
  put("out/frames/.clca-mine", "mine");
  put("out/frames/book.part", "mine");
  const AtomicFile at_work = folder().create("frames/c.png");
  folder().write("d.txt", "x");
  EXPECT_THAT(names("out/frames"),
              ::testing::UnorderedElementsAre(at_work.temporary_path().filename().string(),
                                              ".clca-mine", "a.png", "book.part"));
}

TEST_F(OutputFolderTest, AFileThatTheUserNamedReplacesARegularFileAndIsNotListed) {
  put("out/a.txt", "mine");
  write_whole_file(path("out/a.txt"), "asked for");
  EXPECT_EQ(text("out/a.txt"), "asked for");
  EXPECT_FALSE(fs::exists(path("out/.clca.manifest")));
  folder().clear("", "");
  EXPECT_EQ(text("out/a.txt"), "asked for");
  ASSERT_EQ(::mkfifo(path("out/pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_whole_file(path("out/pipe"), "x"), StoreError);
  EXPECT_TRUE(fs::is_fifo(path("out/pipe")));
}

TEST_F(OutputFolderTest, AGrowingFileKeepsWhatItIsToldAndCutsOffTheRest) {
  const OutputFolder out = folder();
  GrowingFile file(out, "table.csv", 0);
  EXPECT_FALSE(fs::exists(path("out/table.csv")));
  file.append("a,b\n");
  file.append("");
  file.append("1,2\n");
  EXPECT_EQ(file.size_in_bytes(), 8U);
  GrowingFile again(out, "table.csv", 4);
  again.append("3,4\n");
  out.flush();
  EXPECT_EQ(text("out/table.csv"), "a,b\n3,4\n");
  EXPECT_THAT(
      [&] { GrowingFile(out, "table.csv", 9); },
      ThrowsMessage<StoreError>(EndsWith("it is shorter than when the checkpoint was made")));
  EXPECT_THAT([&] { GrowingFile(out, "table.csv", 5); },
              ThrowsMessage<StoreError>(HasSubstr("it has been changed: no line ends")));
  EXPECT_THAT([&] { GrowingFile(out, "other.csv", 5); },
              ThrowsMessage<StoreError>(EndsWith("other.csv: it is missing")));
  EXPECT_EQ(text("out/table.csv"), "a,b\n3,4\n");
  GrowingFile anew(out, "table.csv", 0);
  EXPECT_FALSE(fs::exists(path("out/table.csv")));
  out.flush();
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
  EXPECT_EQ(folder().listed_files().size(), 2 * kFiles);
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
          EXPECT_NO_THROW(GrowingFile(out, name, 0).append("x"));
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
