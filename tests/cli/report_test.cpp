// clca report as a user meets it, and the page as a browser shows it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "clca/image/png.hpp"
#include "support/missing.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::report_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kSmallScene = R"(clca: 1
title: A <b>small</b> run
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
walls:
  gate: {box: [30, 0, 31, 60]}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 30}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 10, width: 320, height: 240}
  series: {every: 1}
)";

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

class ReportCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "small.yaml") << kSmallScene;
    ASSERT_EQ(clca({"run", "small.yaml", "-o", "run"}).code, 0);
  }
  testing::ProgramResult clca(const std::vector<std::string>& arguments) const {
    return testing::run_program(arguments, {.folder = folder_.path().string()});
  }
  std::string text(const fs::path& file) const {
    const auto bytes = testing::bytes_of(folder_.path() / file);
    return {bytes.begin(), bytes.end()};
  }

  testing::ScratchFolder folder_;
};

TEST_F(ReportCommand, WritesAPageAndSaysWhere) {
  auto result = clca({"report", "run"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "run/report.html\n");
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(text("run/report.html"), HasSubstr("A &lt;b&gt;small&lt;/b&gt; run</h1>"));
  result = clca({"report", "run", "-o", "page.html", "--max-frames", "2"});
  EXPECT_EQ(result.out, "page.html\n");
  EXPECT_EQ(count_of(text("page.html"), "data-step="), 2U);
}

TEST_F(ReportCommand, WritesAPageAboutASweepAndRefusesADamagedOneWithOneLine) {
  ASSERT_EQ(clca({"sweep", "small.yaml", "--vary", "rules.inertia=0,0.5", "--seeds", "1..2", "-o",
                  "sweep", "--quiet"})
                .code,
            0);
  auto result = clca({"report", "sweep"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "sweep/report.html\n");
  const std::string page = text("sweep/report.html");
  EXPECT_THAT(page, HasSubstr("class=\"overview\""));
  EXPECT_EQ(count_of(page, "<td data-of=\"Status\">done</td>"), 4U);
  EXPECT_EQ(clca({"report", "sweep"}).code, 0);
  EXPECT_EQ(text("sweep/report.html"), page);
  const std::string request = text("sweep/sweep.json");
  for (const std::string& wrong :
       {std::string("{"), std::string("[]"), request.substr(0, request.size() / 2)}) {
    std::ofstream(folder_.path() / "sweep/sweep.json") << wrong;
    result = clca({"report", "sweep"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr("sweep/sweep.json: it is cut off or no JSON\n"));
    EXPECT_EQ(count_of(result.err, "\n"), 1U);
  }
}

TEST_F(ReportCommand, WithoutPythonIsRefusedWithOneLine) {
  const auto result = testing::run_program(
      {"report", "run"}, {.folder = folder_.path().string(),
                          .environment = {{"CLCA_PYTHON", (folder_.path() / "missing").string()}}});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("clca: error: "), HasSubstr("missing")));
  EXPECT_EQ(count_of(result.err, "\n"), 1U);
  EXPECT_FALSE(fs::exists(folder_.path() / "run/report.html"));
}

TEST_F(ReportCommand, IsClearedAwayByTheNextRun) {
  clca({"report", "run"});
  ASSERT_EQ(clca({"run", "small.yaml", "-o", "run"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "run/report.html"));
}

TEST_F(ReportCommand, AnswersWrongInputInOneLine) {
  auto result = clca({"report", "none"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err,
              ::testing::MatchesRegex("clca: error: cannot read .*/none/run.json: No such "
                                      "file or directory\n"));
  EXPECT_EQ(clca({"report", "run", "--max-frames", "-1"}).code, 2);
  EXPECT_EQ(clca({"report", "run", "-o", "none/page.html"}).code, 1);
  std::ofstream(folder_.path() / "run/series.csv") << "step\n1,2\n";
  result = clca({"report", "run"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, ::testing::MatchesRegex("clca: warning: .*series.csv: line 2: [^\n]*\n"));
}

/// The browser on the PATH, if any.
std::optional<fs::path> find_chromium() {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code error;
    if (fs::exists(fs::path(folder) / "chromium", error)) {
      return fs::path(folder) / "chromium";
    }
  }
  return std::nullopt;
}

class ReportInABrowser : public ReportCommand {
 protected:
  void SetUp() override {
    chromium_ = find_chromium();
    if (!chromium_) {
      CLCA_SKIP_AS_MISSING("no chromium on the PATH; install chromium");
    }
    ReportCommand::SetUp();
    ASSERT_EQ(clca({"report", "run"}).code, 0);
  }
  /// Without a network, without a window, with nothing left over.
  testing::ProgramResult browse(std::vector<std::string> arguments,
                                const std::string& place) const {
    const std::vector<std::string> always = {
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--disable-dev-shm-usage",
        "--enable-logging=stderr",
        "--user-data-dir=" + (folder_.path() / "user").string()};
    arguments.insert(arguments.begin(), always.begin(), always.end());
    arguments.push_back("file://" + (folder_.path() / "run/report.html").string() + place);
    auto result = testing::run_program(
        arguments, {.folder = folder_.path().string(), .program = chromium_->string()});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("CONSOLE"))) << "the script complains";
    return result;
  }

  std::optional<fs::path> chromium_;
};

TEST_F(ReportInABrowser, TheScriptShowsTheLastPictureAndTheFiguresAreThere) {
  const std::string page = browse({"--dump-dom"}, "").out;
  EXPECT_THAT(page, HasSubstr("stage flow ("));
  EXPECT_THAT(page, Not(HasSubstr("id=\"player\" hidden")));
  EXPECT_THAT(page, HasSubstr("<img id=\"frame\" alt=\"Picture of the particles. Step "));
  EXPECT_GE(count_of(page, "<figure class=\"chart\""), 3U);  // surface, share that moves, height
}

TEST_F(ReportInABrowser, APlaceInTheAddressShowsItsPicture) {
  const std::string page = browse({"--dump-dom"}, "#step=10").out;
  EXPECT_THAT(page, AllOf(HasSubstr(">Step 10, stage packing (2 of "),
                          HasSubstr("aria-valuetext=\"Step 10, stage packing\"")));
}

TEST_F(ReportInABrowser, ItsPictureIsNotBlank) {
  browse({"--screenshot=page.png", "--window-size=900,1400"}, "");
  const image::Image image =
      image::decode_png(testing::bytes_of(folder_.path() / "page.png")).image;
  EXPECT_EQ(image.width, 900);
  std::set<std::array<std::uint8_t, 3>> colors;
  for (const image::Rgb& color : image.pixels) {
    colors.insert({color.red, color.green, color.blue});
  }
  EXPECT_GT(colors.size(), 200U);
}

}  // namespace
}  // namespace clca::report_test
