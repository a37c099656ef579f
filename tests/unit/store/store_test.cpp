#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "clca/store/file.hpp"
#include "clca/store/growing_file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "clca/store/whole_file.hpp"

namespace clca::store {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class StoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("clca-store-") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string text_of(const fs::path& file) {
    const auto bytes = read_whole(file);
    return {bytes.begin(), bytes.end()};
  }

  fs::path folder_;
};

using WriteWhole = StoreTest;

TEST_F(WriteWhole, ReplacesAFileAndLeavesNothingBesideIt) {
  write_whole(folder_ / "a.txt", "first");
  write_whole(folder_ / "a.txt", "second");
  EXPECT_EQ(text_of(folder_ / "a.txt"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WriteWhole, NamesThePathAndTheReasonWhenItCannot) {
  EXPECT_THAT(
      [&] { write_whole(folder_ / "no" / "a.txt", "x"); },
      ::testing::ThrowsMessage<StoreError>("cannot write " + (folder_ / "no/a.txt").string() +
                                           ": No such file or directory"));
  EXPECT_THAT([&] { read_whole(folder_ / "none"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("No such file")));
}

TEST_F(WriteWhole, AFilePieceByPieceIsThereWhenItIsFinished) {
  {
    WholeFile file(folder_ / "a.txt");
    file.write("first, ");
    file.write("second");
    file.rewrite_begin(std::vector<std::uint8_t>{'F'});
    file.write(" and third");
    EXPECT_EQ(file.size(), 23U);
    EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
    file.finish();
  }
  EXPECT_EQ(text_of(folder_ / "a.txt"), "First, second and third");
  { WholeFile(folder_ / "a.txt").write("lost"); }
  EXPECT_EQ(text_of(folder_ / "a.txt"), "First, second and third");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WriteWhole, LeavesEverythingAsItWasWhenTheLastStepFails) {
  // A folder cannot be replaced by a file: the rename fails after all was written.
  fs::create_directories(folder_ / "taken" / "inside");
  EXPECT_THROW(write_whole(folder_ / "taken", "x"), StoreError);
  EXPECT_TRUE(fs::exists(folder_ / "taken" / "inside"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST(Table, WritesShortestNumbersAndQuotesText) {
  Table table({"step", "stage", "value"});
  table.add_row({std::uint64_t{3}, std::string("a,\"b\""), 0.1});
  table.add_row({std::uint64_t{4}, std::string("c"), std::nan("")});
  EXPECT_EQ(table.to_csv(), "step,stage,value\n3,\"a,\"\"b\"\"\",0.1\n4,c,\n");
  EXPECT_THROW(table.add_row({0.5}), std::invalid_argument);
}

TEST(Table, QuotesNamesOfColumnsLikeText) {
  EXPECT_EQ(Table({"a,b", "c"}).to_csv(), "\"a,b\",c\n");
}

RunSummary full_summary() {
  return {
      .kind = "boltzmann",
      .version = "1.2.3",
      .scene = "a",
      .seed = 18446744073709551615U,
      .threads = 2,
      .status = "done",
      .particles = 540,
      .steps = 500,
      .wall_seconds = 0.5,
      .step_seconds = 0.25,
      .rate = 1e6,
      .state_hash = 0xabc,
      .compiler = "GNU 12",
      .build_type = "Release",
      .stages = {{.name = "flow",
                  .steps = 100,
                  .ended = "settled",
                  .measures = {{"repose_angle_deg", 41.5}, {"clogged", true}, {"runout_99", {}}}}}};
}

TEST(Summary, HasTheFieldsThatOtherProgramsRelyOn) {
  const auto json = nlohmann::json::parse(to_json(full_summary()));
  EXPECT_EQ(json["clca"], "1.2.3");
  EXPECT_EQ(json["kind"], "boltzmann");
  EXPECT_EQ(json["seed"], 18446744073709551615U);
  EXPECT_EQ(json["state_hash"], "0000000000000abc");
  EXPECT_EQ(json["stages"][0]["measures"]["repose_angle_deg"], 41.5);
  EXPECT_EQ(json["stages"][0]["measures"]["clogged"], true);
  EXPECT_TRUE(json["stages"][0]["measures"]["runout_99"].is_null());
}

using ReadSummary = StoreTest;

TEST_F(ReadSummary, GivesBackWhatWasWritten) {
  RunSummary summary = full_summary();
  summary.wall_seconds = 0.1 + 0.2;  // needs all digits
  write_whole(folder_ / "run.json", to_json(summary));
  const RunSummary read = read_summary(folder_ / "run.json");
  EXPECT_EQ(to_json(read), to_json(summary));
  EXPECT_EQ(read.seed, summary.seed);
  EXPECT_EQ(read.wall_seconds, summary.wall_seconds);
  EXPECT_EQ(read.stages.at(0).measures, summary.stages.at(0).measures);
}

TEST_F(ReadSummary, WhatIsCutOffAnywhereIsAnError) {
  const std::string whole = to_json(full_summary());
  const fs::path file = folder_ / "run.json";
  for (std::size_t length = 0; length + 2 < whole.size(); ++length) {  // 2: the last brace
    write_whole(file, whole.substr(0, length));
    EXPECT_THAT([&] { read_summary(file); },
                ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("run.json: it is cut")));
  }
}

TEST_F(ReadSummary, FieldsOfTheWrongKindAreAnErrorThatNamesThem) {
  const fs::path file = folder_ / "run.json";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"seed", "-1"},       {"seed", "1.5"},          {"steps", "\"many\""},
      {"steps", "null"},    {"status", "7"},          {"state_hash", "\"xyz\""},
      {"state_hash", "12"}, {"stages", "{}"},         {"stages", "[3]"},
      {"build", "[]"},      {"wall_seconds", "null"}, {"threads", "2147483648"}};
  for (const auto& [key, value] : cases) {
    auto json = nlohmann::ordered_json::parse(to_json(full_summary()));
    json[key] = nlohmann::ordered_json::parse(value);
    write_whole(file, json.dump());
    EXPECT_THROW(read_summary(file), StoreError) << key << ": " << value;
    json.erase(key);
    write_whole(file, json.dump());
    EXPECT_THAT([&] { read_summary(file); },
                ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("'" + key + "'")));
  }
  for (const char* text : {"3", "[]", "null", "{}", "\"run\"", "\xff", "{\"seed\": 1e999}"}) {
    write_whole(file, std::string_view(text));
    EXPECT_THROW(read_summary(file), StoreError) << text;
  }
  EXPECT_THAT([&] { read_summary(folder_ / "none"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("No such file")));
}

using RunFolderTest = StoreTest;

TEST_F(RunFolderTest, ClearsWhatAnEarlierRunLeftAndNothingElse) {
  std::optional<RunFolder> first(RunFolder::for_new_run(folder_ / "run"));
  first->make_frames();
  fs::create_directories(first->path() / "plots");
  fs::create_directories(first->path() / "export");
  for (const char* name :
       {"run.json", "series.csv", "cycles.csv", "profile-flow.csv", "contacts-flow.csv",
        "histogram-5.csv", "checkpoint.h5", "checkpoint-previous.h5", "trajectory.h5",
        "series.csv.part-17", "plots/profile.png", "export/scene.gsd", "export/mine.txt",
        "notes.txt", "other.csv"}) {
    write_whole(first->path() / name, "x");
  }
  write_whole(first->frame("scene", 120), "x");
  write_whole(first->path() / "frames" / "mine.png", "x");
  first.reset();
  const RunFolder second = RunFolder::for_new_run(folder_ / "run");
  EXPECT_EQ(second.frame("scene", 120).filename(), "scene-000120.png");
  EXPECT_FALSE(fs::exists(second.summary()));
  EXPECT_FALSE(fs::exists(second.table("series")));
  EXPECT_FALSE(fs::exists(second.table("cycles")));
  EXPECT_FALSE(fs::exists(second.table("profile", "flow")));
  EXPECT_FALSE(fs::exists(second.table("contacts", "flow")));
  EXPECT_FALSE(fs::exists(second.table("histogram", "5")));
  EXPECT_FALSE(fs::exists(second.path() / "plots" / "profile.png"));
  EXPECT_FALSE(fs::exists(second.path() / "export" / "scene.gsd"));
  EXPECT_TRUE(fs::exists(second.path() / "export" / "mine.txt"));
  EXPECT_FALSE(fs::exists(second.frame("scene", 120)));
  for (const char* name : {"checkpoint.h5", "checkpoint-previous.h5", "trajectory.h5"}) {
    EXPECT_FALSE(fs::exists(second.path() / name)) << name;
  }
  EXPECT_FALSE(fs::exists(second.path() / "series.csv.part-17")) << "what a killed run left";
  EXPECT_TRUE(fs::exists(second.path() / "notes.txt"));
  EXPECT_TRUE(fs::exists(second.path() / "other.csv"));
  EXPECT_TRUE(fs::exists(second.path() / "frames" / "mine.png"));
}

TEST_F(RunFolderTest, KeepsFramesUpToAStepWhenARunGoesOn) {
  const RunFolder run = RunFolder::for_new_run(folder_ / "run");
  run.make_frames();
  for (const std::uint64_t step : {10U, 20U, 1'000'000U}) {
    write_whole(run.frame("scene", step), "x");
  }
  run.remove_frames_after(10);
  EXPECT_TRUE(fs::exists(run.frame("scene", 10)));
  EXPECT_FALSE(fs::exists(run.frame("scene", 20)));
  EXPECT_FALSE(fs::exists(run.frame("scene", 1'000'000)));
  run.remove_frames_after(std::nullopt);
  EXPECT_FALSE(fs::exists(run.frame("scene", 10)));
}

TEST_F(RunFolderTest, IsOfOneRunAtATime) {
  std::optional<RunFolder> first(RunFolder::for_new_run(folder_ / "run"));
  EXPECT_THAT([&] { RunFolder::for_resumed_run(folder_ / "run"); },
              ::testing::ThrowsMessage<StoreError>(::testing::EndsWith(
                  fmt::format("run: another run is at work in it (process {})", ::getpid()))));
  RunFolder moved = std::move(*first);
  first.reset();
  EXPECT_THROW(RunFolder::for_new_run(folder_ / "run"), StoreError);
  EXPECT_NO_THROW(RunFolder::for_new_run(folder_ / "other"));
}

TEST_F(RunFolderTest, TakesOverTheLockOfADeadProcess) {
  fs::create_directories(folder_ / "run");
  write_whole(folder_ / "run" / "lock", "999999\n");
  { const RunFolder run = RunFolder::for_new_run(folder_ / "run"); }
  EXPECT_FALSE(fs::exists(folder_ / "run" / "lock"));
}

using GrowingFileTest = StoreTest;

TEST_F(GrowingFileTest, KeepsWhatItIsToldAndCutsOffTheRest) {
  const fs::path path = folder_ / "table.csv";
  GrowingFile file(path, 0);
  EXPECT_FALSE(fs::exists(path));
  file.append("a,b\n");
  file.append("");
  file.append("1,2\n");
  EXPECT_EQ(file.bytes(), 8U);
  GrowingFile again(path, 4);
  again.append("3,4\n");
  again.sync();
  const auto bytes = read_whole(path);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "a,b\n3,4\n");
  GrowingFile anew(path, 0);
  EXPECT_FALSE(fs::exists(path));
  anew.sync();
}

TEST_F(GrowingFileTest, OneThatIsTooShortIsRefused) {
  write_whole(folder_ / "table.csv", "a");
  EXPECT_THAT([&] { GrowingFile(folder_ / "table.csv", 2); },
              ::testing::ThrowsMessage<StoreError>(
                  ::testing::EndsWith("it is shorter than when the checkpoint was made")));
}

TEST_F(RunFolderTest, TouchesNothingInAFolderThatIsNoRunFolder) {
  write_whole(folder_ / "profile-of-my-own.csv", "x");
  const RunFolder run = RunFolder::for_new_run(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "profile-of-my-own.csv"));
}

TEST_F(RunFolderTest, SaysWhyAFolderCannotBeMade) {
  write_whole(folder_ / "file", "x");
  EXPECT_THAT([&] { RunFolder::for_new_run(folder_ / "file"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("Not a directory")));
}

}  // namespace
}  // namespace clca::store
