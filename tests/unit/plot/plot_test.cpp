// Which figures the tables of a run allow, and what gnuplot is told. Nothing is drawn here.

#include "clca/plot/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/input_error.hpp"
#include "plot/gnuplot.hpp"
#include "support/runs.hpp"

namespace clca::plot::plot_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

class FiguresTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(run());
    std::filesystem::create_directories(templates());
    store::RunSummary summary;
    summary.scene = "it's";
    summary.stages = {{.name = "packing", .ended = "settled", .measures = {{"chance", 0.25}}},
                      {.name = "flow", .ended = "settled", .measures = {}}};
    write("run.json", store::to_json(summary));
  }
  std::filesystem::path run() const { return folder_.path() / "run"; }
  std::filesystem::path templates() const { return folder_.path() / "templates"; }
  void write(const std::string& file, const std::string& text) const {
    store::write_whole(run() / file, text);
  }
  void write_template(const std::string& name, const std::string& text) const {
    store::write_whole(templates() / (name + ".gp"), text);
  }
  std::vector<Figure> found(const std::vector<std::string>& only = {},
                            const Choice& choice = {}) const {
    return figures(run(), only, templates(), choice);
  }
  std::vector<std::string> chosen(const Choice& choice) const {
    std::vector<std::string> result;
    for (const Figure& figure : found({}, choice)) {
      result.push_back(figure.name);
    }
    return result;
  }
  std::vector<std::string> names(const std::vector<std::string>& only = {}) const {
    std::vector<std::string> result;
    for (const Figure& figure : found(only)) {
      result.push_back(figure.name);
    }
    return result;
  }

  testing::ScratchFolder folder_;
};

TEST_F(FiguresTest, AFigureNeedsAValueOtherThanZeroInEachColumn) {
  for (const char* column : {"full", "zero", "empty", "absent"}) {
    write_template(column, std::string("# Why.\n#\n# needs: series.csv: time, ") + column + "\n");
  }
  write("series.csv", "time,full,zero,empty\n0,0,0,\n1,-2.5,0,\n");
  EXPECT_THAT(names(), ElementsAre("full"));
}

TEST_F(FiguresTest, RowsMayBeChosenByText) {
  write_template("a", "# needs: series.csv: kind=a, value\n");
  write_template("b", "# needs: series.csv: kind=b, value\n");
  write("series.csv", "kind,value\na,0\nb,1\n");
  EXPECT_THAT(names(), ElementsAre("b"));
}

TEST_F(FiguresTest, AllTablesThatAreNeededMustBeThere) {
  write_template("both", "# needs: series.csv: x\n# needs: other.csv: y\n");
  write_template("one", "# needs: series.csv: x\n");
  write("series.csv", "x\n1\n");
  EXPECT_THAT(names(), ElementsAre("one"));
  write("other.csv", "y\n1\n");
  EXPECT_THAT(names(), ElementsAre("both", "one"));
}

TEST_F(FiguresTest, FilesComeInTheOrderOfStagesOrTimes) {
  write_template("p", "# needs: p-*.csv: x\n");
  for (const char* file : {"p-flow.csv", "p-packing.csv", "p-a b'.csv"}) {
    write(file, "x\n1\n");
  }
  EXPECT_THAT(found().at(0).setting,
              HasSubstr("array files[2] = [\"p-packing.csv\", \"p-flow.csv\"];"
                        "array labels[2] = [\"packing\", \"flow\"];"));
  write_template("h", "# needs: h-*.csv: x\n");
  for (const char* file : {"h-10.csv", "h-0.5.csv", "h-5.csv"}) {
    write(file, "x\n1\n");
  }
  write("h-3.csv", "x\n0\n");
  EXPECT_THAT(found().at(0).setting, HasSubstr("labels[3] = [\"0.5\", \"5\", \"10\"];"));
}

TEST_F(FiguresTest, GroupsAreTheValuesOfAColumnAsTheyCome) {
  write_template("g", "# needs: series.csv: x\n# groups: stage\n");
  write("series.csv", "stage,x\nb,1\nb,2\na,1\n");
  EXPECT_THAT(found().at(0).setting,
              HasSubstr("groups[2] = [\"b\", \"a\"];group_column = \"stage\";"));
  write("series.csv", "x\n1\n");
  EXPECT_THAT(found().at(0).setting, HasSubstr("groups[1] = [\"\"];"));
  write("series.csv", "stage,x\n../../a,1\n");
  EXPECT_THAT([&] { found(); }, ThrowsMessage<text::InputError>(
                                    HasSubstr("series.csv: line 2: column 'stage' holds no name")));
}

TEST_F(FiguresTest, ThereMayBeOneForEachGroupOrFile) {
  write_template("g", "# needs: p-*.csv: x\n# groups: r\n# one figure for each: group\n");
  write_template("f", "# needs: p-*.csv: x\n# one figure for each: file\n");
  write("p-flow.csv", "r,x\n0.2,1\n1,1\n");
  write("p-packing.csv", "r,x\n0.2,1\n3,0\n");  // nothing to draw for 3
  EXPECT_THAT(names(), ElementsAre("f-packing", "f-flow", "g-0.2", "g-1"));
  EXPECT_THAT(names({"g"}), ElementsAre("g-0.2", "g-1"));
  EXPECT_THAT(names({"g-1", "f-flow"}), ElementsAre("f-flow", "g-1"));
  EXPECT_THAT(found({"g-1"}).at(0).setting, HasSubstr("groups[1] = [\"1\"];"));
}

TEST_F(FiguresTest, TemplatesLearnOfColumnsAndMeasuresThatAreThere) {
  write_template("t",
                 "# needs: series.csv: x\n# may use: more.csv\n# measure: chance\n"
                 "# measure: none\n");
  write("series.csv", "x,x_se,y\n1,2,0\n");
  write("more.csv", "z\n1\n");
  const std::string setting = found().at(0).setting;
  EXPECT_THAT(setting, HasSubstr("known_columns = \"|more.csv:z|series.csv:x|series.csv:x_se|\";"));
  EXPECT_THAT(setting, HasSubstr("chance = 2.5"));
  EXPECT_THAT(setting, HasSubstr("none = NaN;"));
}

TEST_F(FiguresTest, AColumnMayBeAPrefixOrHaveToChange) {
  write_template("a", "# needs: series.csv: x, travel.*\n");
  write_template("b", "# needs: series.csv: changing n\n");
  write("series.csv",
        "x,n,travel.lid,travel.no sign,travel.rest,travel.gate\n1,5,1,1,0,2\n2,5,1,1,0,2\n");
  EXPECT_THAT(names(), ElementsAre("a"));
  EXPECT_THAT(found().at(0).setting,
              HasSubstr("array columns[2] = [\"travel.lid\", \"travel.gate\"];"
                        "array column_labels[2] = [\"lid\", \"gate\"];"));
  write("series.csv", "x,n\n1,5\n2,0\n");
  EXPECT_THAT(names(), ElementsAre("b"));
}

TEST_F(FiguresTest, AFigureHasTheTitleOfItsSceneAndTheDescriptionOfItsTemplate) {
  write_template("t", "# What is\n# shown.\n#\n# needs: series.csv: x\n# More.\n");
  write("series.csv", "x\n1\n");
  EXPECT_EQ(found().at(0).title, "it's");
  EXPECT_EQ(found().at(0).description, "What is shown.");
}

TEST_F(FiguresTest, UnreadableTablesLeaveTheOtherFigures) {
  write_template("a", "# needs: a.csv: x\n");
  write_template("b", "# needs: b.csv: x\n");
  write("a.csv", "x\none\n");
  write("b.csv", "x\n1\n");
  std::vector<std::string> warnings;
  const auto left = figures_of_readable_tables(
      run(), templates(), [&](const std::string& text) { warnings.push_back(text); });
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].name, "b");
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("a.csv: line 2: 'one' in column 'x' is no number")));
}

TEST_F(FiguresTest, TemplatesLearnTheTimeThatStepsTake) {
  write_template("t", "# needs: series.csv: x\n");
  write("series.csv", "x\n1\n");
  EXPECT_THAT(found().at(0).setting, HasSubstr("time_column = \"step\";"));
  store::RunSummary summary;
  summary.scene = "small";
  summary.units = {
      .length_unit = "m", .time_unit = "s", .velocity_unit = "m/s", .time_step = 0.001};
  write("run.json", store::to_json(summary));
  EXPECT_THAT(found().at(0).setting, HasSubstr("time_column = \"time\";"));
}

TEST_F(FiguresTest, TemplatesLearnTheNamesAndUnitsOfColumns) {
  write_template("t", "# needs: series.csv: mean_height\n");
  write("series.csv", "mean_height,own\n1,2\n");
  EXPECT_THAT(found().at(0).setting,
              HasSubstr("array quantity_keys[3] = [\"\", \"mean_height\", \"own\"];"
                        "array quantity_labels[3] = [\"\", \"Mean height of the particles "
                        "(spacings)\", \"own\"];"));
}

TEST_F(FiguresTest, CaptionsSayWhichPartIsShownAndReportsBeginWithTheHighestRank) {
  write_template("a", "# What.\n#\n# needs: p-*.csv: x\n# one figure for each: file\n");
  write_template("b",
                 "# Why.\n#\n# needs: series.csv: x\n# groups: stage\n# rank: 2\n"
                 "# one figure for each: group\n");
  write("p-flow.csv", "x\n1\n");
  write("p-5.csv", "x\n1\n");
  write("series.csv", "stage,x\nflow,1\n");
  std::vector<std::string> captions;
  for (const Figure& figure : figures_of_readable_tables(run(), templates(), {})) {
    captions.push_back(figure.description);
  }
  EXPECT_THAT(captions, ElementsAre("Why. stage: flow.", "What. Stage: flow.", "What. Time: 5."));
}

TEST_F(FiguresTest, ColumnsThatAreChosenAreDrawnInPlaceOfTheOthers) {
  write_template("t", "# needs: series.csv: a\n");
  write_template("columns", "# Columns.\n#\n# one figure for each: column\n");
  write("series.csv", "step,stage,a,b\n0,flow,1,2\n1,end,2,3\n");
  write("other.csv", "kind,c,d\nx,1,2\n");
  EXPECT_THAT(names(), ElementsAre("t"));
  EXPECT_THAT(chosen({.y = {"b", "a"}}), ElementsAre("b", "a"));
  const Figure over_time = found({}, {.y = {"b"}, .log_y = true}).at(0);
  EXPECT_THAT(over_time.setting, HasSubstr("array groups[2] = [\"flow\", \"end\"];"));
  EXPECT_THAT(over_time.setting,
              HasSubstr("x_column = \"step\"; y_column = \"b\"; log_axes = 'y';"));
  const Figure other = found({}, {.x = "c", .y = {"d"}, .over = {"kind"}}).at(0);
  EXPECT_THAT(other.setting, HasSubstr("array files[1] = [\"other.csv\"];"));
  EXPECT_THAT(other.setting, HasSubstr("array groups[1] = [\"x\"];"));
  write("numbers.csv", "n,e,f\n10,1,2\n2,1,2\n");
  EXPECT_THAT(found({}, {.x = "e", .y = {"f"}, .over = {"n"}}).at(0).setting,
              HasSubstr("array groups[2] = [\"2\", \"10\"];"));
  const auto expect = [&](const Choice& choice, const std::string& reason) {
    EXPECT_THAT([&] { found({}, choice); }, ThrowsMessage<text::InputError>(HasSubstr(reason)));
  };
  expect({.y = {"stagg"}}, "no table with a column 'stagg'; did you mean 'stage'?");
  expect({.x = "c", .y = {"a"}}, "no table with all of the columns a, c");
  expect({.y = {"d"}}, "say which column of other.csv is x");
  expect({.y = {"a"}, .over = {"b", "c"}}, "for each value of one column, not of b and c");
  expect({.log_x = true}, "of a run, say which columns are y, too");
}

TEST_F(FiguresTest, TablesThatNoTemplateNamesAreNotRead) {
  write_template("t", "# needs: series.csv: x\n");
  write("series.csv", "x\n1\n");
  write("mine.csv", "\"");
  EXPECT_THAT(names(), ElementsAre("t"));
}

TEST_F(FiguresTest, WhatCannotBeDrawnIsSaidInOneLine) {
  write_template("t", "# needs: series.csv: kind=a, x\n");
  const auto expect = [&](const std::vector<std::string>& only, const std::string& reason) {
    EXPECT_THAT([&] { found(only); }, ThrowsMessage<text::InputError>(HasSubstr(reason)));
  };
  expect({}, "no tables that a figure could be drawn from");
  write("series.csv", "kind,x\na,1\n");
  write_template("u", "# needs: series.csv: y\n");
  expect({"v"}, "no figure 'v' (there are: t)");
  expect({"t", "u"}, "the tables do not allow the figure 'u', which needs series.csv: y");
  write("series.csv", "kind,x\na,one\n");
  expect({}, "series.csv: line 2: 'one' in column 'x' is no number");
  write("series.csv", "kind,x\na,1");
  expect({}, "series.csv: line 2: the file is cut off");
  write("run.json", "{");
  expect({}, "run.json: it is cut off or no JSON");
}

TEST_F(FiguresTest, ATemplateThatDoesNotSayWhatItNeedsIsNamed) {
  write_template("t", "plot sin(x)\n");
  EXPECT_THAT([&] { found(); }, ThrowsMessage<PlotError>(HasSubstr("t.gp: it does not say")));
  write_template("t", "# needs: series.csv: x\n# one figure for each: moon\n");
  EXPECT_THAT([&] { found(); }, ThrowsMessage<PlotError>(HasSubstr("t.gp: one figure for each: ")));
}

class SweepFiguresTest : public FiguresTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(templates());
    std::filesystem::create_directories(run());
    write("sweep.json", "{}");
    write_template("sweep",
                   "# A sweep.\n#\n# needs: measures.csv: mean\n"
                   "# one figure for each: measure\n");
  }
};

constexpr const char* kSweepColumns =
    "stage,measure,mean,standard_deviation,standard_error,runs,min,max,low,high\n";

TEST_F(SweepFiguresTest, ThereIsOneForEachStageAndMeasureWithAMean) {
  write("measures.csv",
        std::string("rules.inertia,") + kSweepColumns +
            "0,flow,slope,40,1,0.5,4,39,41,39.5,40.5\n0,flow,mixed,,,,0,,,,\n"
            "0.9,flow,slope,30,1,0.25,4,29,31,29.75,30.25\n0,end,slope,50,,,1,50,50,,\n");
  EXPECT_THAT(names(), ElementsAre("sweep-flow-slope", "sweep-end-slope"));
  const std::string setting = found().front().setting;
  EXPECT_THAT(setting, HasSubstr("x_label = \"rules.inertia\";"));
  EXPECT_THAT(setting, HasSubstr("array xs[2] = [0, 0.9];"));
  EXPECT_THAT(setting, HasSubstr("array means[2] = [40, 30];"));
  EXPECT_THAT(setting, HasSubstr("array lows[2] = [39.5, 29.75];array highs[2] = [40.5, 30.25];"));
  EXPECT_THAT(found().back().setting, HasSubstr("array lows[1] = [50];array highs[1] = [50];"));
}

TEST_F(SweepFiguresTest, AxisAndTitleSayWhatIsDrawn) {
  write("sweep.json", R"({"title": "Collapse"})");
  write("measures.csv", std::string("rules.inertia,") + kSweepColumns +
                            "0,flow,repose_angle_deg,40,1,0.5,4,39,41,39.5,40.5\n"
                            "0,flow,clogged.drain,1,0,,4,1,1,,\n0,flow,own,1,0,,4,1,1,,\n");
  const std::vector<Figure> all = found();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].title, "Collapse");
  EXPECT_THAT(all[0].setting, HasSubstr("y_label = \"Slope (degrees)\";"));
  EXPECT_THAT(all[1].setting, HasSubstr("y_label = \"Clogged, drain\";"));
  EXPECT_THAT(all[2].setting, HasSubstr("y_label = \"own\";"));
}

TEST_F(SweepFiguresTest, NamesAndUnitsAreThoseOfTheRuns) {
  store::RunSummary one;
  one.scene = "one";
  one.units = {.length_unit = "m", .time_unit = "s", .velocity_unit = "m/s", .time_step = 0.001};
  one.derived = {
      {.name = "own", .value = "=steps", .unit = "time", .about = "Duration", .location = {}}};
  std::filesystem::create_directories(run() / "runs/a");
  write("runs/a/run.json", store::to_json(one));
  write("runs.csv", "a,status,folder\n0,failed,\n0,done,runs/a\n");
  write("measures.csv", std::string("a,") + kSweepColumns + "0,flow,own,1,0,,4,1,1,,\n" +
                            "0,flow,outflow_sites_per_time,1,0,,4,1,1,,\n");
  EXPECT_THAT(found().front().setting, HasSubstr("y_label = \"Duration (s)\";"));
  EXPECT_THAT(found().back().setting, HasSubstr("y_label = \"Outflow over time (sites/s)\";"));
}

TEST_F(SweepFiguresTest, FurtherKeysAreLinesAndWordsStandSideBySide) {
  write("measures.csv", std::string("model,a,b,") + kSweepColumns +
                            "automaton,1,x,flow,slope,40,1,1,4,39,41,39,41\n"
                            "automaton,2,x,flow,slope,41,1,1,4,39,41,40,42\n"
                            "contact,1,x,flow,slope,20,1,1,4,19,21,19,21\n");
  const std::string setting = found().front().setting;
  EXPECT_THAT(setting, HasSubstr("has_words = 1;"));
  EXPECT_THAT(setting, HasSubstr("array words[2] = [\"automaton\", \"contact\"];"));
  EXPECT_THAT(setting, HasSubstr("array xs[3] = [1, 1, 2];"));
  EXPECT_THAT(setting, HasSubstr("array lines[2] = [\"a=1, b=x\", \"a=2, b=x\"];"));
  EXPECT_THAT(setting, HasSubstr("array of_lines[3] = [1, 2, 1];"));
}

constexpr const char* kTwoKeys =
    "0.5,automaton,1,flow,slope,40,1,1,4,39,41,39,41\n"
    "0.5,automaton,1,flow,reach,2,1,1,4,1,3,1,3\n"
    "0.25,automaton,1,flow,slope,30,1,1,4,29,31,29,31\n"
    "0.25,automaton,1,flow,reach,1,1,1,4,0,2,0.5,1.5\n"
    "0.5,contact,1,flow,slope,20,1,1,4,19,21,19,21\n"
    "0.5,contact,1,flow,reach,3,1,1,4,2,4,2,4\n"
    "0.5,contact,2,flow,slope,10,1,1,4,9,11,9,11\n";

TEST_F(SweepFiguresTest, TheAxisTheMeasuresAndTheCurvesMayBeChosen) {
  write("measures.csv", std::string("a,model,b,") + kSweepColumns + kTwoKeys);
  EXPECT_THAT(chosen({.y = {"slope"}}), ElementsAre("sweep-flow-slope"));
  // A curve for each model, a figure for each b, points in the order of the axis.
  const Choice over = {.x = "a", .y = {"slope"}, .over = {"model"}, .log_x = true, .log_y = true};
  EXPECT_THAT(chosen(over), ElementsAre("sweep-flow-slope-1", "sweep-flow-slope-2"));
  const Figure first = found({}, over).at(0);
  EXPECT_THAT(first.setting, HasSubstr("array xs[3] = [0.25, 0.5, 0.5];"));
  EXPECT_THAT(first.setting, HasSubstr("array lines[2] = [\"automaton\", \"contact\"];"));
  EXPECT_THAT(first.setting, HasSubstr("part = \"flow, b=1\";"));
  EXPECT_THAT(first.setting, HasSubstr("log_axes = 'xy';"));
  // Against a measure, which has errors as well.
  const Figure against = found({}, {.x = "reach", .y = {"slope"}, .over = {"model"}}).at(0);
  EXPECT_THAT(against.setting, HasSubstr("array xs[3] = [1, 2, 3];"));
  EXPECT_THAT(against.setting, HasSubstr("array lefts[3] = [0.5, 1, 2];"));
  EXPECT_THAT(against.setting, HasSubstr("array means[3] = [30, 40, 20];"));
  const auto expect = [&](const Choice& choice, const std::string& reason) {
    EXPECT_THAT([&] { found({}, choice); }, ThrowsMessage<text::InputError>(HasSubstr(reason)));
  };
  expect({.y = {"slop"}}, "measures.csv: no measure 'slop'; did you mean 'slope'?");
  expect({.x = "rech"}, "no varied key or measure 'rech'; did you mean 'reach'?");
  expect({.over = {"modl"}}, "no varied key 'modl'; did you mean 'model'?");
}

TEST_F(SweepFiguresTest, EachHasACaptionOfItsOwnAndThoseThatDifferMostComeFirst) {
  store::RunSummary one;
  one.scene = "one";
  one.derived = {{.name = "own", .value = "=steps", .about = "Duration", .location = {}}};
  std::filesystem::create_directories(run() / "runs/a");
  write("runs/a/run.json", store::to_json(one));
  write("runs.csv", "a,status,folder\n0,done,runs/a\n");
  write("measures.csv", std::string("a,") + kSweepColumns +
                            "0,flow,height_mean,10,1,1,4,9,11,9,11\n"
                            "1,flow,height_mean,11,1,1,4,9,11,10,12\n"
                            "0,flow,runout_99,10,1,1,4,9,11,9,11\n"
                            "1,flow,runout_99,90,1,1,4,9,11,89,91\n"
                            "0,flow,moved_share,0,0,0,4,0,0,0,0\n"
                            "1,flow,moved_share,0,0,0,4,0,0,0,0\n"
                            "0,flow,own,1,1,1,4,1,1,1,1\n");
  std::vector<std::string> captions;
  for (const Figure& figure : figures_of_readable_tables(run(), templates(), {})) {
    captions.push_back(figure.description);
  }
  EXPECT_THAT(captions,
              ElementsAre("Duration, against a, at the end of stage flow. A sweep.",
                          "Run-out of 99 %: how far the 99th percentile of its sites lies beyond "
                          "its origins, against a, at the end of stage flow. A sweep.",
                          "Mean height: of the surface, over the columns with particles, against "
                          "a, at the end of stage flow. A sweep."));
}

TEST_F(SweepFiguresTest, MeansOverTheSeedsHaveACurveForEachCombination) {
  write_template("means", "# Means.\n#\n# one figure for each: mean\n");
  write("measures.csv", std::string("a,model,b,") + kSweepColumns + kTwoKeys);
  write("mean-series.csv",
        "a,model,b,stage,step,runs,h,h_se,zero,zero_se\n"
        "1,automaton,0,flow,0,2,1,0.5,0,0\n1,automaton,0,flow,2,2,2,,0,0\n"
        "1,automaton,0,end,0,2,1,0.5,0,0\n1,contact,0,flow,0,2,4,1,0,0\n");
  const auto names = chosen({.y = {"h"}});
  EXPECT_THAT(names, ElementsAre("mean-series-flow-h", "mean-series-end-h"));
  const Figure flow = found({"mean-series-flow-h"}).at(0);
  EXPECT_EQ(flow.description, "h, against Step: flow. Means.");
  EXPECT_THAT(flow.setting, HasSubstr("array firsts[2] = [0, 3];array lasts[2] = [1, 3];"));
  EXPECT_THAT(flow.setting, HasSubstr("x_low = 0; x_high = 2; y_low = 0.5; y_high = 5;"));
  EXPECT_THAT(flow.setting,
              HasSubstr("array lines[2] = [\"a=1, model=automaton, b=0\", \"a=1, model=contact, "
                        "b=0\"];"));
  EXPECT_THAT(found({}, {.y = {"h"}, .over = {"model"}}).front().setting,
              HasSubstr("array lines[2] = [\"automaton\", \"contact\"];"));
}

TEST_F(SweepFiguresTest, NumbersAreInTheirOrderHoweverTheyWereVaried) {
  write_template("means", "# Means.\n#\n# one figure for each: mean\n");
  write("measures.csv", std::string("a,b,c,") + kSweepColumns +
                            "1,10,u,flow,slope,40,1,1,4,39,41,39,41\n"
                            "1,2,u,flow,slope,41,1,1,4,39,41,40,42\n");
  write("mean-series.csv",
        "a,b,c,stage,step,runs,h,h_se\n1,10,u,flow,0,2,1,0.5\n1,2,u,flow,0,2,2,0.5\n");
  for (const char* name : {"sweep", "means"}) {
    EXPECT_THAT(found({name}, {.over = {"b"}}).at(0).setting,
                HasSubstr("array lines[2] = [\"b=2\", \"b=10\"];"));
    const std::vector<Figure> apart = found({name}, {.over = {"c"}});
    ASSERT_EQ(apart.size(), 2U);
    EXPECT_THAT(apart[0].setting, HasSubstr("b=2\";"));
    EXPECT_THAT(apart[1].setting, HasSubstr("b=10\";"));
  }
}

TEST_F(SweepFiguresTest, ThereIsNoneWhereOnlyTheSeedVaries) {
  write("measures.csv", std::string(kSweepColumns) + "flow,slope,40,1,0.5,4,39,41,39.5,40.5\n");
  EXPECT_THAT([&] { names(); }, ThrowsMessage<text::InputError>(HasSubstr("no tables")));
}

TEST(Templates, AreFoundAndSayWhatTheyNeed) {
  const testing::ScratchFolder empty;
  store::RunSummary summary;
  summary.scene = "empty";
  store::write_whole(empty.path() / "run.json", store::to_json(summary));
  EXPECT_THROW(figures(empty.path(), {}, template_folder()), text::InputError);
}

TEST(Literal, MeansNothingButItself) {
  EXPECT_EQ(literal("a-0.5, b=2"), "\"a-0.5, b=2\"");
  EXPECT_EQ(literal("'it's \"`date`\" \\ @x"), R"("\047it\047s \042\140date\140\042 \134 \100x")");
  EXPECT_EQ(literal("'2nd, 3rd\xC3\xA9"), R"("\047\062nd, 3rd\303\251")");
  EXPECT_EQ(literal("two\nlines"), "\"two lines\"");
}

}  // namespace
}  // namespace clca::plot::plot_test
