#include "clca/compare/compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clca/statistics/distribution.hpp"
#include "clca/store/table.hpp"
#include "support/compared_runs.hpp"
#include "support/runs.hpp"

namespace clca::compare::compare_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::histogram_lines;
using testing::sloping_shares;

class Compare : public ::testing::Test {
 protected:
  Compare() {
    write_automaton({"packing", "shaking"});
    write_fluctuation("shaking", sloping_shares(0.01), sloping_shares(0.002));
    testing::write_gas(gas(), "5", 0.001, 0.02);
  }

  fs::path automaton() const { return folder_.path() / "automaton"; }
  fs::path gas() const { return folder_.path() / "gas"; }
  fs::path out() const { return folder_.path() / "out"; }

  void write_automaton(const std::vector<std::string>& stages) const {
    fs::create_directories(automaton());
    store::RunSummary summary;
    summary.scene = "shaken";
    for (const std::string& stage : stages) {
      summary.stages.push_back(
          {.name = stage, .ended = "settled", .measures = {{"fluctuation_samples", 4000.0}}});
    }
    store::write_whole(automaton() / "run.json", store::to_json(summary));
  }
  void write_fluctuation(const std::string& stage, const std::vector<double>& shares,
                         const std::vector<double>& local) const {
    std::string text = "lower,upper,share,share_local,reference\n";
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
      text += fmt::format("{},{},{},{},{}\n", bin, bin + 1, shares[bin], local[bin],
                          1.0 / static_cast<double>(shares.size()));
    }
    store::write_whole(automaton() / ("fluctuation-" + stage + ".csv"), text);
  }
  void write_histogram(const std::string& time, const std::string& text) const {
    store::write_whole(gas() / ("histogram-" + time + ".csv"), text);
  }
  Comparison compared(const RunChoice& choice = {}) const {
    return comparison(automaton(), gas(), choice);
  }
  /// The one line with which a comparison is refused; empty when it is not.
  std::string refusal(const RunChoice& choice = {}) const {
    try {
      compared(choice);
    } catch (const CompareError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }

  testing::ScratchFolder folder_;
};

TEST_F(Compare, PutsBothRunsIntoOneTableByQuantile) {
  write(compared(), out());
  const store::ReadTable table = store::read_table(out() / "comparison.csv");
  EXPECT_THAT(table.names,
              ElementsAre("quantile_lower", "quantile_upper", "automaton", "automaton_local",
                          "boltzmann_translational", "boltzmann_rotational", "reference"));
  ASSERT_EQ(table.rows(), 20U);
  const auto last = [&](const std::string& column) {
    return testing::csv_column(out() / "comparison.csv", column).back();
  };
  EXPECT_DOUBLE_EQ(last("quantile_lower"), 0.95);
  EXPECT_DOUBLE_EQ(last("quantile_upper"), 1);
  EXPECT_DOUBLE_EQ(last("automaton"), sloping_shares(0.01).back());
  EXPECT_DOUBLE_EQ(last("boltzmann_rotational"), sloping_shares(0.02).back());
  EXPECT_DOUBLE_EQ(last("reference"), 0.05);
}

TEST_F(Compare, ReplacesAnotherComparisonButNoRun) {
  write(compared(), out());
  EXPECT_NO_THROW(write(compared(), out()));
  EXPECT_THROW(write(compared(), automaton()), CompareError);
  EXPECT_EQ(store::read_summary(automaton() / "run.json").kind, "automaton");
}

TEST_F(Compare, TellsTheDistancesFromChiSquareAndOfOneRunFromTheOther) {
  const std::vector<Distance> all = distances(compared());
  std::vector<std::string> names;
  for (const Distance& distance : all) {
    names.push_back(distance.name);
  }
  EXPECT_THAT(names, ElementsAre("automaton", "automaton_local", "boltzmann_translational",
                                 "boltzmann_rotational", "automaton:boltzmann_translational",
                                 "automaton:boltzmann_rotational",
                                 "automaton_local:boltzmann_translational",
                                 "automaton_local:boltzmann_rotational"));
  double affinity = 0;
  for (const double share : sloping_shares(0.01)) {
    affinity += std::sqrt(share * 0.05);
  }
  EXPECT_NEAR(all[0].distance, 1 - affinity, 1e-15);
  EXPECT_DOUBLE_EQ(all[0].floor, 18.0 / 8 / 4000);
  EXPECT_EQ(all[0].samples, 4000U);
  EXPECT_NEAR(all[4].distance,
              statistics::hellinger_distance(sloping_shares(0.01), sloping_shares(0.001)), 1e-15);
  EXPECT_DOUBLE_EQ(all[4].floor, 18.0 / 8 / 4000 + 18.0 / 8 / 10'000);
}

TEST_F(Compare, TakesTheLastStageWithATableAndTheLatestTimeUnlessToldOtherwise) {
  write_automaton({"packing", "shaking", "rest"});
  write_fluctuation("packing", sloping_shares(0.03), sloping_shares(0.03));
  testing::write_gas(gas(), "0.5", 0.03, 0.03);
  testing::write_gas(gas(), "15", 0.04, 0.04);
  EXPECT_EQ(compared().stage, "shaking");
  EXPECT_EQ(compared().time, 15);
  const Comparison chosen = compared({.stage = "packing", .time = 0.5});
  EXPECT_EQ(chosen.stage, "packing");
  EXPECT_EQ(chosen.time, 0.5);
  EXPECT_EQ(chosen.distributions[0].shares, sloping_shares(0.03));
  EXPECT_EQ(chosen.distributions[2].shares, sloping_shares(0.03));
}

TEST_F(Compare, RefusesAStageOrATimeThatIsNotThereAndNamesThoseThatAre) {
  EXPECT_THAT(refusal({.stage = "packing"}), AllOf(HasSubstr("'packing'"), HasSubstr("shaking")));
  EXPECT_THAT(refusal({.time = 7}), AllOf(HasSubstr("time 7"), HasSubstr("there are 5")));
  fs::remove(gas() / "histogram-5.csv");
  EXPECT_THAT(refusal(), HasSubstr("output.histograms"));
  fs::remove(automaton() / "fluctuation-shaking.csv");
  EXPECT_THAT(refusal(), HasSubstr("output.fields"));
}

TEST_F(Compare, RefusesWhatIsNoRunOrOneOfTheWrongKind) {
  EXPECT_THROW(comparison(gas(), automaton(), {}), CompareError);
  EXPECT_THROW(comparison(automaton(), automaton(), {}), CompareError);
  EXPECT_THROW(comparison(folder_.path(), gas(), {}), CompareError);
  store::write_whole(gas() / "run.json", "{");
  EXPECT_THAT(refusal(), HasSubstr("run.json"));
}

TEST_F(Compare, RefusesOtherBinsThanEquallyProbableOnesInTheSameNumber) {
  const std::string head = "energy,lower,upper,share,reference\n";
  write_histogram("5", head + histogram_lines("translational,", sloping_shares(0, 10), ",0.1") +
                           histogram_lines("rotational,", sloping_shares(0, 10), ",0.1"));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("10 bins"), HasSubstr("20")));
  write_histogram("5", head + "translational,0,1,0.5,0.4\ntranslational,1,,0.5,0.6\n");
  EXPECT_THAT(refusal(), HasSubstr("not equally probable"));
  write_histogram("5", head);
  EXPECT_THAT(refusal(), HasSubstr("0 bins"));
}

TEST_F(Compare, RefusesABrokenTable) {
  const std::string head = "energy,lower,upper,share,reference\n";
  for (const std::string text :
       {"", "energy,lower,upper\n", "energy,lower,upper,share,reference\ntranslational,0\n"}) {
    write_histogram("5", text);
    EXPECT_THAT(refusal(), HasSubstr("histogram-5.csv")) << text;
  }
  for (const char* share : {"nan", "", "1e", "-0.1", "0.9"}) {
    write_histogram("5", head + fmt::format("translational,0,,{},1\n", share));
    EXPECT_THAT(refusal(), HasSubstr("histogram-5.csv")) << share;
  }
}

TEST_F(Compare, ChoosesTheRestitutionWhereThereAreSeveral) {
  std::string text = "restitution,energy,lower,upper,share,share_se,reference\n";
  for (const double slope : {0.01, 0.02}) {
    const std::string restitution = slope == 0.01 ? "0.5" : "0.9";
    text += histogram_lines(restitution + ",translational,", sloping_shares(slope), ",0.001,0.05");
    text += histogram_lines(restitution + ",rotational,", sloping_shares(slope), ",0.001,0.05");
  }
  write_histogram("5", text);
  EXPECT_EQ(compared({.restitution = 0.9}).distributions[2].shares, sloping_shares(0.02));
  for (const RunChoice& choice : {RunChoice{}, RunChoice{.restitution = 0.7}}) {
    EXPECT_THAT(refusal(choice), HasSubstr("0.5, 0.9"));
  }
  testing::write_gas(gas(), "5", 0, 0);
  EXPECT_THAT(refusal({.restitution = 0.9}), HasSubstr("no column 'restitution'"));
}

TEST_F(Compare, LeavesOutTheRotationOfSpheresThatDoNotSpin) {
  write_histogram("5", "energy,lower,upper,share,reference\n" +
                           histogram_lines("translational,", sloping_shares(0), ",0.05") +
                           histogram_lines("rotational,", std::vector<double>(20, 0), ",0.05"));
  EXPECT_EQ(compared().distributions.size(), 3U);
  EXPECT_EQ(distances(compared()).size(), 5U);
}

}  // namespace
}  // namespace clca::compare::compare_test
