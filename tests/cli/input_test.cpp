// Options and files that make no sense, or have no end.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::input_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kScene = R"(clca: 1
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
stages:
  - {name: packing, fill: {region: [0, 0, 30, 60], counts: {small: 30}}}
)";

class InputTest : public ::testing::Test {
 protected:
  InputTest() { std::ofstream(path("small.yaml")) << kScene; }

  fs::path path(const fs::path& name) const { return folder_.path() / name; }
  testing::ProgramResult run(const std::vector<std::string>& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  void expect_refused(const std::vector<std::string>& arguments,
                      const ::testing::Matcher<std::string>& message) const {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2) << ::testing::PrintToString(arguments) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(path("renders")));
  }

  testing::ScratchFolder folder_;
};

TEST_F(InputTest, WholeNumbersArePlainDigitsInRange) {
  const std::vector<std::vector<std::string>> options = {
      {"run", "small.yaml", "--seed"},    {"run", "small.yaml", "--frames-every"},
      {"run", "small.yaml", "--threads"}, {"resume", "out", "--threads"},
      {"sweep", "small.yaml", "--jobs"},  {"diff", "a", "b", "--pixels"},
      {"diff", "a", "b", "--tolerance"},  {"render", "out", "--from"},
      {"render", "out", "--to"},          {"render", "out", "--fps"},
      {"render", "out", "--columns"},     {"export", "out", "--format", "xyz", "--from"},
      {"plot", "out", "--width"},         {"export", "out", "--format", "xyz", "--to"},
      {"report", "out", "--max-frames"},  {"export", "out", "--format", "xyz", "--every"}};
  const auto expect_wrong = [&](std::vector<std::string> arguments, const std::string& value) {
    const std::string option = arguments.back();
    arguments.push_back(value);
    expect_refused(arguments,
                   AllOf(StartsWith("clca: error: " + option + ": expected a whole number"),
                         HasSubstr(value)));
  };
  for (const auto& option : options) {
    expect_wrong(option, "-1");
  }
  for (const char* value :
       {"+1", " 1", "1 ", "1e3", "0x10", "010", "1.0", "one", "nan", "18446744073709551616"}) {
    expect_wrong(options.front(), value);
  }
  EXPECT_EQ(run({"check", "small.yaml", "--seed", "18446744073709551615"}).code, 0);
}

TEST_F(InputTest, SizesAndTimesAreNumbersWithTheirUnits) {
  for (const char* value : {"-1", "0", "1.5GiB", "4 GiB", "GiB", "4GiBs", "inf", "1e3",
                            "16777216TiB", "18446744073709551616"}) {
    expect_refused({"check", "small.yaml", "--memory-limit", value},
                   HasSubstr("--memory-limit: expected a size"));
  }
  for (const char* value : {"1TiB", "4096MiB", "4g", "1000000000"}) {
    EXPECT_EQ(run({"check", "small.yaml", "--memory-limit", value}).code, 0) << value;
  }
  for (const char* value : {"-1", "nan", "inf", "-0", "1e10", "1d", "2 h", "", "h"}) {
    expect_refused({"run", "small.yaml", "--time-limit", value}, StartsWith("clca: error: "));
  }
  EXPECT_EQ(run({"run", "small.yaml", "-o", "out", "--time-limit", "0.5h"}).code, 0);
  expect_refused({"compare", "a", "b", "--time", "nan"}, HasSubstr("--time: expected a number"));
}

TEST_F(InputTest, AnArgumentIsNotEmpty) {
  expect_refused({"run", "small.yaml", "-o", ""}, HasSubstr("an argument is empty"));
  expect_refused({"plot", ""}, HasSubstr("an argument is empty"));
}

TEST_F(InputTest, AFormatThatThereIsNotIsToldInPrintableText) {
  for (const std::string name : {"foo", "0", "VTP", "\x01"}) {
    const auto result = run({"export", "out", "--format", name});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr("--format: "));
    EXPECT_THAT(result.err, AllOf(HasSubstr("vtp"), HasSubstr("gsd"), HasSubstr("xyz")));
    EXPECT_EQ(std::count_if(result.err.begin(), result.err.end(),
                            [](char letter) { return letter > 0 && letter < ' '; }),
              1)
        << result.err;
  }
}

TEST_F(InputTest, ASceneFileWhoseNameCannotNameARunIsRefused) {
  for (const std::string& name :
       {std::string("..yaml"), std::string(".yaml"), std::string("..."), std::string(250, 'a')}) {
    fs::copy_file(path("small.yaml"), path(name), fs::copy_options::overwrite_existing);
    expect_refused({"run", name}, AllOf(HasSubstr(":1:1: error: "), HasSubstr("names the run")));
  }
  fs::copy_file(path("small.yaml"), path("a b.yaml"));
  EXPECT_EQ(run({"run", "a b.yaml"}).code, 0);
  EXPECT_TRUE(fs::exists(path("renders/a b/run.json")));
}

TEST_F(InputTest, FilesWithoutAnEndAreRefused) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const char* file : {"pipe", "/dev/zero"}) {
    expect_refused({"run", file}, HasSubstr("it is not a regular file"));
    expect_refused({"diff", file, file}, HasSubstr("it is not a regular file"));
  }
  expect_refused({"run", "."}, HasSubstr("it is a folder"));
}

TEST_F(InputTest, SoAreThoseInTheFolderOfARun) {
  fs::create_directories(path("out"));
  store::RunSummary summary;
  summary.kind = "boltzmann";
  summary.scene = "gas";
  store::write_whole_file(path("out/run.json"), store::to_json(summary));
  ASSERT_EQ(::mkfifo(path("out/series.csv").c_str(), 0600), 0);
  expect_refused({"plot", "out"}, HasSubstr("series.csv: it is not a regular file"));
  fs::remove(path("out/run.json"));
  fs::create_symlink("/dev/zero", path("out/run.json"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"plot", "out"},
                                             {"report", "out"},
                                             {"render", "out"},
                                             {"export", "out", "--format", "xyz"}}) {
    expect_refused(arguments, HasSubstr("run.json: it is not a regular file"));
  }
}

TEST_F(InputTest, ASceneOfNothingButBracketsIsRefusedBeforeAParserKeepsThemAll) {
  std::ofstream(path("deep.yaml")) << std::string(std::size_t{4} << 20U, '[');
  expect_refused({"check", "deep.yaml"},
                 StartsWith("deep.yaml:1:33: error: nested deeper than 32 levels"));
}

TEST_F(InputTest, ASceneThatResumeWouldNotReadIsRefusedBeforeItRuns) {
  std::string walls;
  for (int wall = 0; wall < 38; ++wall) {
    std::string parts = "{box: [0,0,1,1]}";
    for (int part = 1; part < (wall < 37 ? 1000 : 126); ++part) {
      parts += ",{box: [0,0,1,1]}";
    }
    walls += "  w" + std::to_string(wall) + ":\n    parts: [" + parts + "]\n";
  }
  std::ofstream(path("small.yaml"), std::ios::app) << "walls:\n" << walls;
  expect_refused({"check", "small.yaml"}, AllOf(StartsWith("small.yaml, with all defaults:"),
                                                HasSubstr(": error: more than 260000 values")));
}

}  // namespace
}  // namespace clca::input_test
