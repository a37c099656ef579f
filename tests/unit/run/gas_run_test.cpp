// Run folders of the Boltzmann equation.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "clca/boltzmann/closure.hpp"
#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "support/runs.hpp"

namespace clca::run::gas_run_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

constexpr const char* kGas = R"(clca: 1
seed: 5
boltzmann:
  particles: 500
  restitution: 0.5
  friction: 0.3
  until: 2
output:
  series: {every: 0.5}
  histograms: [0, 1.2, 2]
  bins: q10
)";

scene::BoltzmannScene gas(const std::vector<scene::Override>& overrides = {}) {
  return std::get<scene::BoltzmannScene>(scene::parse_any(kGas, "gas.yaml", overrides));
}

class GasRunTest : public ::testing::Test {
 protected:
  store::RunSummary run_gas(const std::vector<scene::Override>& overrides = {},
                            const RunEvents& events = {},
                            const std::atomic<int>* stop = nullptr) const {
    return run(gas(overrides), {.folder = folder_.path(), .threads = 1, .stop_signal = stop},
               events);
  }
  store::ParsedTable table(const std::string& name) const {
    return store::read_table(folder_.path() / (name + ".csv"));
  }
  nlohmann::json json() const {
    return nlohmann::json::parse(testing::bytes_of(folder_.path() / "run.json"));
  }
  bool leaves(const std::string& name) const { return fs::exists(folder_.path() / name); }

  testing::ScratchFolder folder_;
};

const std::vector<std::string> kSeries = {"time",   "t_tr",  "t_rot",  "collisions",  "a2_tr",
                                          "a2_rot", "dh_tr", "dh_rot", "correlation", "alignment"};

TEST_F(GasRunTest, ASeriesHasARowForEachTimeAndTheEnd) {
  run_gas({"boltzmann.until=1.8", "output.histograms=[0, 1.2]"});
  const auto series = table("series");
  EXPECT_EQ(series.column_names, kSeries);
  EXPECT_THAT(series.column_numbers("time"), ElementsAre(0, 0.5, 1, 1.5, 1.8));
  EXPECT_EQ(series.column_numbers("t_tr").front(), 1);
  EXPECT_EQ(series.column_numbers("t_rot").front(), 1);
  EXPECT_EQ(series.column_numbers("collisions").front(), 0);
  EXPECT_LT(series.column_numbers("t_tr").back(), 0.5);
  EXPECT_GT(series.column_numbers("collisions").back(), 2);
}

TEST_F(GasRunTest, MultiplesThatMissATimeOfTheSceneByRoundingAreThatTime) {
  // 17 * 0.1 is beyond 1.7, and 3 * 0.1 beyond 0.3.
  run_gas({"boltzmann.until=1.7", "output.series.every=0.1", "output.histograms=[0.3, 1.7]"});
  const std::vector<double> times = table("series").column_numbers("time");
  ASSERT_EQ(times.size(), 18U);
  EXPECT_EQ(times[3], 0.3);
  EXPECT_EQ(times.back(), 1.7);
}

TEST_F(GasRunTest, AListOfRestitutionsHasAColumnOfItsOwnEvenWithOneEntry) {
  run_gas({"boltzmann.restitution=[0.5, 1]", "boltzmann.until=0.5", "output.histograms=[0.5]"});
  EXPECT_THAT(table("series").column_numbers("restitution"), ElementsAre(0.5, 0.5, 1, 1));
  EXPECT_THAT(table("closure").column_numbers("restitution"), ElementsAre(0.5, 0.5, 1, 1));
  EXPECT_EQ(table("histogram-0.5").column_names.front(), "restitution");
  EXPECT_EQ(table("histogram-0.5").row_count(), 2U * 2U * 10U);
  run_gas({"boltzmann.restitution=[0.5]", "boltzmann.until=0.5", "output.histograms=[0.5]"});
  EXPECT_THAT(table("series").column_numbers("restitution"), ElementsAre(0.5, 0.5));
}

TEST_F(GasRunTest, AHistogramHasARowForEachBinOfEitherEnergy) {
  run_gas();
  for (const std::string name : {"histogram-0", "histogram-1.2", "histogram-2"}) {
    const auto histogram = table(name);
    EXPECT_THAT(histogram.column_names,
                ElementsAre("energy", "lower", "upper", "share", "reference"));
    ASSERT_EQ(histogram.row_count(), 20U);
    const auto& energies = *histogram.find_column("energy");
    EXPECT_EQ(energies[9], "translational");
    EXPECT_EQ(energies[10], "rotational");
    const auto shares = histogram.column_numbers("share");
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.begin() + 10, 0.0), 1, 1e-12);
    EXPECT_NEAR(std::accumulate(shares.begin() + 10, shares.end(), 0.0), 1, 1e-12);
    EXPECT_NEAR(histogram.column_numbers("reference")[3], 0.1, 1e-9);
    EXPECT_EQ(histogram.column_numbers("lower")[0], 0);
    EXPECT_EQ(histogram.find_column("upper")->at(9), "") << "no end";
    EXPECT_EQ(histogram.find_column("upper")->at(8), histogram.find_column("lower")->at(9));
  }
  EXPECT_FALSE(leaves("histogram-1.csv"));
}

TEST_F(GasRunTest, ATimeOfAHistogramAloneGivesNoRowOfTheSeries) {
  run_gas();
  EXPECT_THAT(table("series").column_numbers("time"), ElementsAre(0, 0.5, 1, 1.5, 2));
}

TEST_F(GasRunTest, TheClosureStandsBesideTheSeries) {
  run_gas();
  const auto closure = table("closure");
  EXPECT_THAT(closure.column_names, ElementsAre("time", "t_tr", "t_rot"));
  EXPECT_EQ(closure.column_numbers("time"), table("series").column_numbers("time"));
  const auto expected =
      boltzmann::temperatures_after({.restitution = 0.5, .friction = 0.3, .roughness = 0},
                                    {.translational = 1, .rotational = 2.5}, 2);
  EXPECT_NEAR(closure.column_numbers("t_tr").back(), expected.translational, 1e-9);
  EXPECT_NEAR(closure.column_numbers("t_rot").back(), expected.rotational / 2.5, 1e-9);
}

TEST_F(GasRunTest, ShearAddsTheStressesAndTheSteadyStateOfSmoothSpheres) {
  run_gas({"boltzmann.friction=0", "boltzmann.shear_rate=0.5"});
  auto columns = kSeries;
  columns.insert(columns.end(), {"p_xx", "p_yy", "p_xy"});
  EXPECT_EQ(table("series").column_names, columns);
  EXPECT_LT(table("series").column_numbers("p_xy").back(), 0);
  const auto closure = table("closure");
  EXPECT_THAT(closure.column_names, ElementsAre("time", "t_tr", "p_xx", "p_yy", "p_xy"));
  EXPECT_THAT(closure.column_numbers("time"), ElementsAre(0, 2));
  EXPECT_EQ(closure.column_numbers("t_tr")[1], boltzmann::steady_shear_flow(0.5, 0.5).temperature);
}

TEST_F(GasRunTest, ShearWithFrictionHasNoClosure) {
  run_gas({"boltzmann.shear_rate=0.5"});
  EXPECT_FALSE(leaves("closure.csv"));
  run_gas({"boltzmann.shear_rate=0.5", "boltzmann.roughness=-1"});  // smooth, whatever the friction
  EXPECT_EQ(table("closure").column_numbers("t_tr")[1],
            boltzmann::steady_shear_flow(0.5, 0.5).temperature);
}

TEST_F(GasRunTest, WithoutSpinsAtFirstTheirTemperatureIsRelativeToTheTranslationalOne) {
  for (const std::string friction : {"0", "0.3"}) {
    const std::vector<scene::Override> overrides = {
        "boltzmann.energy_ratio=0", "boltzmann.friction=" + friction, "boltzmann.ensemble=2",
        "boltzmann.particles=20000"};
    run_gas(overrides);
    const auto rotational = table("series").column_numbers("t_rot");
    const auto closed_form = table("closure").column_numbers("t_rot");
    EXPECT_EQ(rotational.front(), 0);
    EXPECT_EQ(closed_form.front(), 0);
    EXPECT_EQ(rotational.back() > 0, friction != "0");
    EXPECT_NEAR(rotational.back(), closed_form.back(), 0.1 * closed_form.back());
    EXPECT_EQ(json()["stages"][0]["measures"]["t_rot"], rotational.back());
  }
}

// The mean and its standard error, against the members run one by one.
TEST_F(GasRunTest, AnEnsembleGivesTheMeanOfItsMembersAndItsError) {
  constexpr int kMembers = 3;
  std::vector<double> members;
  std::uint64_t steps = 0;
  for (std::uint64_t member = 0; member < kMembers; ++member) {
    const auto seed = boltzmann::member_seed(5, member);
    steps += run_gas({fmt::format("seed={}", seed)}).steps;
    members.push_back(table("series").column_numbers("t_tr").back());
    EXPECT_EQ(table("series").find_column("t_tr_se"), nullptr);
  }
  const auto summary = run_gas({"boltzmann.ensemble=3"});
  EXPECT_EQ(summary.steps, steps);
  EXPECT_EQ(summary.particles, 1500U);
  const auto expected = testing::sample(members);
  const auto series = table("series");
  ASSERT_EQ(series.column_names.size(), 1 + 2 * (kSeries.size() - 1));
  EXPECT_EQ(series.column_names[2], "t_tr_se");
  EXPECT_NEAR(series.column_numbers("t_tr").back(), expected.mean, 1e-14);
  EXPECT_NEAR(series.column_numbers("t_tr_se").back(), expected.standard_error, 1e-14);
  EXPECT_THAT(table("histogram-2").column_names,
              ElementsAre("energy", "lower", "upper", "share", "share_se", "reference"));
}

TEST_F(GasRunTest, TheSummarySaysWhatWasRunAndHowItEnded) {
  const auto summary = run_gas({"boltzmann.restitution=[0.5, 0.9]", "boltzmann.ensemble=2"});
  const auto read = json();
  EXPECT_EQ(read["kind"], "boltzmann");
  EXPECT_EQ(read["status"], "done");
  EXPECT_EQ(read["scene"], "gas");
  EXPECT_EQ(read["particles"], 1000);
  EXPECT_EQ(read["steps"], summary.steps);
  EXPECT_GT(read["collisions_per_second"].get<double>(), 0);
  ASSERT_EQ(read["stages"].size(), 2U);
  const auto& last = read["stages"][1];
  EXPECT_EQ(last["name"], "restitution-0.9");
  EXPECT_EQ(last["ended"], "time");
  const auto& measures = last["measures"];
  EXPECT_EQ(measures["restitution"], 0.9);
  EXPECT_EQ(measures["time"], 2);
  EXPECT_DOUBLE_EQ(measures["hellinger_floor"].get<double>(), 8.0 / (8 * 500));
  const auto series = table("series");
  for (const std::string column : {"t_tr", "t_tr_se", "collisions", "dh_rot", "alignment_se"}) {
    EXPECT_EQ(measures[column].get<double>(), series.column_numbers(column).back()) << column;
  }
}

TEST_F(GasRunTest, TheResolvedSceneRunsToTheSameState) {
  const auto first = run_gas({"boltzmann.restitution=[0.5, 0.9]"});
  const testing::ScratchFolder again;
  const auto scene = scene::parse_any_file(folder_.path() / "scene.yaml");
  EXPECT_EQ(run(std::get<scene::BoltzmannScene>(scene), {.folder = again.path()}).state_hash,
            first.state_hash);
}

TEST_F(GasRunTest, StoppedBeforeTheFirstStepItLeavesTablesWithoutRowsBeyondTheBeginning) {
  std::atomic<int> stop = 2;
  EXPECT_EQ(run_gas({}, {}, &stop).status, "interrupted");
  EXPECT_EQ(json()["status"], "interrupted");
  EXPECT_EQ(json()["stages"][0]["ended"], "interrupted");
  EXPECT_EQ(table("series").column_names, kSeries);
  EXPECT_EQ(table("series").row_count(), 0U);
  EXPECT_FALSE(leaves("histogram-0.csv"));
}

// Asked from an event, in the second of three cases, each long enough for a few of them.
// A gas that is cold makes one step from row to row.
TEST_F(GasRunTest, StopsBetweenRowsThatAreOneStepApart) {
  std::atomic<int> stop = 0;
  const RunEvents events = {
      .gas_progress = [&](const GasProgress& progress) { stop = progress.time > 1000 ? 2 : 0; },
      .progress_interval = {}};
  const auto summary = run_gas(
      {"boltzmann.until=1000000", "output.series.every=10", "output.histograms=[]"}, events, &stop);
  EXPECT_EQ(summary.status, "interrupted");
  EXPECT_LT(table("series").row_count(), 100'000U);
}

TEST_F(GasRunTest, StoppedOnItsWayItLeavesWholeTablesOfWhatWasDone) {
  std::atomic<int> stop = 0;
  const RunEvents events = {.gas_progress =
                                [&](const GasProgress& progress) {
                                  EXPECT_EQ(progress.stage_count, 3U);
                                  EXPECT_GE(progress.time, 0);
                                  EXPECT_LE(progress.time, progress.end_time);
                                  stop = progress.stage_number == 2 && progress.time > 1 ? 15 : 0;
                                },
                            .progress_interval = {}};
  run_gas({"boltzmann.particles=500", "boltzmann.restitution=[0.5, 1, 0.9]", "boltzmann.friction=0",
           "boltzmann.until=200", "output.series.every=1", "output.histograms=[0, 200]"},
          events, &stop);
  const auto read = json();
  EXPECT_EQ(read["status"], "interrupted");
  ASSERT_EQ(read["stages"].size(), 2U);
  EXPECT_EQ(read["stages"][0]["ended"], "time");
  EXPECT_EQ(read["stages"][1]["ended"], "interrupted");
  const auto series = table("series");
  const auto restitutions = series.column_numbers("restitution");
  EXPECT_EQ(std::count(restitutions.begin(), restitutions.end(), 0.5), 201);
  EXPECT_GT(std::count(restitutions.begin(), restitutions.end(), 1), 0);
  EXPECT_LT(series.column_numbers("time").back(), 200);
  EXPECT_EQ(read["stages"][1]["measures"]["time"], series.column_numbers("time").back());
  EXPECT_EQ(table("histogram-0").row_count(), 2U * 20U);
  EXPECT_EQ(table("histogram-200").row_count(), 20U) << "of the first alone";
}

TEST_F(GasRunTest, AnEnsembleThatIsStoppedLeavesWhatItsMembersHaveComeTo) {
  std::atomic<int> stop = 0;
  const RunEvents events = {.gas_progress =
                                [&](const GasProgress& progress) {
                                  stop = progress.done_gases == 1 && progress.time > 0 ? 2 : 0;
                                },
                            .progress_interval = {}};
  run_gas({"boltzmann.ensemble=3", "boltzmann.particles=2000", "boltzmann.until=200",
           "output.histograms=[0]"},
          events, &stop);
  EXPECT_EQ(json()["status"], "interrupted");
  EXPECT_EQ(json()["stages"][0]["measures"]["time"], 200);
  EXPECT_EQ(json()["stages"][0]["measures"]["gases"], 1);
  const store::ParsedTable series = table("series");
  EXPECT_GT(series.column_numbers("t_tr").front(), 0.9);
  EXPECT_EQ(series.column_numbers("time").back(), 200);
  EXPECT_FALSE(std::isnan(series.column_numbers("t_tr_se").front()));
  EXPECT_TRUE(std::isnan(series.column_numbers("t_tr_se").back())) << "of one gas nothing is known";
}

TEST_F(GasRunTest, RunAgainIntoItsFolderItClearsTheHistogramsOfTheFirst) {
  run_gas();
  std::ofstream(folder_.path() / "mine.txt") << "x";
  run_gas({"output.histograms=[1]"});
  EXPECT_TRUE(leaves("histogram-1.csv"));
  EXPECT_FALSE(leaves("histogram-1.2.csv"));
  EXPECT_FALSE(leaves("histogram-2.csv"));
  EXPECT_TRUE(leaves("mine.txt"));
}

TEST_F(GasRunTest, WarnsOfLongStepsOfThePrintedSchemeOnly) {
  std::vector<std::string> warnings;
  const RunEvents events = {.warning = [&](const std::string& text) { warnings.push_back(text); }};
  run_gas({"boltzmann.scheme=ogawa-kato"}, events);
  EXPECT_THAT(warnings, ElementsAre());
  run_gas({"boltzmann={particles: 500, restitution: 0.5, friction: 0.3, until: 2, scheme: "
           "ogawa-kato, time_step: 0.05}"},
          events);
  EXPECT_THAT(warnings, ElementsAre(::testing::HasSubstr("a time step of 0.05 is too long")));
}

}  // namespace
}  // namespace clca::run::gas_run_test
