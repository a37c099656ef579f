#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "support/runs.hpp"

namespace clca::store::store_test {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class StoreTest : public ::testing::Test {
 protected:
  static std::string text_of(const fs::path& file) {
    const auto bytes = testing::bytes_of(file);
    return {bytes.begin(), bytes.end()};
  }

  testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

using WriteWhole = StoreTest;

TEST_F(WriteWhole, ReplacesAFileAndLeavesNothingBesideIt) {
  write_whole_file(folder_ / "a.txt", "first");
  write_whole_file(folder_ / "a.txt", "second");
  EXPECT_EQ(text_of(folder_ / "a.txt"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(WriteWhole, NamesThePathAndTheReasonWhenItCannot) {
  EXPECT_THAT(
      [&] { write_whole_file(folder_ / "no" / "a.txt", "x"); },
      ::testing::ThrowsMessage<StoreError>("cannot write " + (folder_ / "no/a.txt").string() +
                                           ": No such file or directory"));
  EXPECT_THAT([&] { testing::bytes_of(folder_ / "none"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("No such file")));
}

TEST_F(WriteWhole, LeavesEverythingAsItWasWhenItCannotReplaceWhatIsThere) {
  fs::create_directories(folder_ / "taken" / "inside");
  fs::create_symlink("elsewhere", folder_ / "link");
  for (const char* name : {"taken", "link"}) {
    EXPECT_THAT(
        [&] { write_whole_file(folder_ / name, "x"); },
        ::testing::ThrowsMessage<StoreError>(::testing::EndsWith("it is not a regular file")));
  }
  EXPECT_TRUE(fs::exists(folder_ / "taken" / "inside"));
  EXPECT_EQ(fs::read_symlink(folder_ / "link"), "elsewhere");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
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
      .title = "A scene",
      .seed = 18446744073709551615U,
      .threads = 2,
      .ranks = 3,
      .status = "done",
      .particles = 540,
      .steps = 500,
      .wall_seconds = 0.5,
      .step_seconds = 0.25,
      .rate_per_second = 1e6,
      .state_hash = 0xabc,
      .compiler = "GNU 12",
      .build_type = "Release",
      .stages = {{.name = "flow",
                  .steps = 100,
                  .end_reason = "settled",
                  .measures = {{"repose_angle_deg", 41.5}, {"clogged", true}, {"runout_99", {}}},
                  .notes = {"runout_99 is null: \"nothing\" is left"}}}};
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
  write_whole_file(folder_ / "run.json", to_json(summary));
  const RunSummary read = read_summary(folder_ / "run.json");
  EXPECT_EQ(to_json(read), to_json(summary));
  EXPECT_EQ(read.title, summary.title);
  EXPECT_EQ(read.seed, summary.seed);
  EXPECT_EQ(read.wall_seconds, summary.wall_seconds);
  EXPECT_EQ(read.stages.at(0).measures, summary.stages.at(0).measures);
  EXPECT_EQ(read.stages.at(0).notes, summary.stages.at(0).notes);
  EXPECT_FALSE(read.units.has_value());
  summary.units = {.length_unit = "m",
                   .time_unit = "√(spacing/gravity)",
                   .velocity_unit = "m/s",
                   .spacing = 0.001,
                   .time_step = 0.1 + 0.2};
  write_whole_file(folder_ / "run.json", to_json(summary));
  EXPECT_EQ(read_summary(folder_ / "run.json").units->time_step, 0.1 + 0.2);
  EXPECT_EQ(to_json(read_summary(folder_ / "run.json")), to_json(summary));
}

TEST_F(ReadSummary, WhatIsCutOffAnywhereIsAnError) {
  const std::string whole = to_json(full_summary());
  const fs::path file = folder_ / "run.json";
  for (std::size_t length = 0; length + 2 < whole.size(); ++length) {  // 2: the last brace
    write_whole_file(file, whole.substr(0, length));
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
    write_whole_file(file, json.dump());
    EXPECT_THROW(read_summary(file), StoreError) << key << ": " << value;
    json.erase(key);
    write_whole_file(file, json.dump());
    EXPECT_THAT([&] { read_summary(file); },
                ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("'" + key + "'")));
  }
  for (const char* text : {"3", "[]", "null", "{}", "\"run\"", "\xff", "{\"seed\": 1e999}"}) {
    write_whole_file(file, std::string_view(text));
    EXPECT_THROW(read_summary(file), StoreError) << text;
  }
  auto json = nlohmann::ordered_json::parse(to_json(full_summary()));
  json["units"] = {{"time", "s"}};
  write_whole_file(file, json.dump());
  EXPECT_THAT([&] { read_summary(file); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("'length'")));
  EXPECT_THAT([&] { read_summary(folder_ / "none"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("No such file")));
}

TEST_F(ReadSummary, TextThatTakesMemoryOrTimeOutOfProportionIsRefused) {
  const auto reason = [](const std::string& json) -> std::string {
    try {
      parse_summary(json, "run.json");
    } catch (const StoreError& error) {
      return error.what();
    }
    return "read";
  };
  for (const char* opening : {"[", "{\"a\":", "[{\"a\":"}) {
    std::string deep;
    while (deep.size() < 5'000'000) {
      deep += opening;
    }
    EXPECT_EQ(reason(deep), "cannot read run.json: it is nested deeper than 16 levels") << opening;
  }
  std::string wide = "{\"a\": {";
  for (int key = 0; key < 300'000; ++key) {
    wide += '"' + std::to_string(key) + "\":0,";
  }
  EXPECT_EQ(reason(wide), "cannot read run.json: it has an object of more than 1000 keys");
  write_whole_file(folder_ / "run.json", std::string_view("{"));
  fs::resize_file(folder_ / "run.json", std::uintmax_t{1} << 30U);  // a hole
  EXPECT_THAT([&] { read_summary(folder_ / "run.json"); },
              ::testing::ThrowsMessage<StoreError>(::testing::HasSubstr("larger than the limit")));
}

TEST_F(ReadSummary, NamesThatLeadOutOfTheFolderAreRefused) {
  for (const char* name : {"../../evil", "..", "", "a/b", "a\nb", ".hidden"}) {
    RunSummary summary = full_summary();
    summary.scene = name;
    EXPECT_THROW(parse_summary(to_json(summary), "run.json"), StoreError) << name;
    summary = full_summary();
    summary.stages.at(0).name = name;
    EXPECT_THROW(parse_summary(to_json(summary), "run.json"), StoreError) << name;
  }
}

}  // namespace
}  // namespace clca::store::store_test
