// Runs of the Boltzmann equation that are stopped, killed or prolonged, and go on.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "run/saved.hpp"
#include "support/runs.hpp"
#include "support/thread_ranks.hpp"

namespace clca::run::gas_resume_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kMaxBytes = 1e9;

// About as many steps as there are rows: many for a gas so small.
constexpr const char* kGas = R"(clca: 1
seed: 5
boltzmann:
  particles: 300
  restitution: 0.8
  friction: 0.3
  until: 2
output:
  series: {every: 0.1}
  histograms: [0, 0.75]
  bins: q10
)";

using Overrides = std::vector<scene::Override>;

scene::BoltzmannScene gas(const Overrides& overrides = {}) {
  return std::get<scene::BoltzmannScene>(scene::parse_any(kGas, "gas.yaml", overrides));
}

/// As from a file and back.
template <class T>
T reread(const T& value) {
  T result;
  reflection::decode(reflection::encode(value), kMaxBytes, result);
  return result;
}

// --- one gas, stopped exactly ---

struct Kind {
  const char* name;
  Overrides overrides;
};

class AGasThatGoesOn : public ::testing::TestWithParam<Kind> {};

TEST_P(AGasThatGoesOn, HasTheSameBitsHoweverOftenItWasStopped) {
  const scene::BoltzmannScene scene = gas(GetParam().overrides);
  const model::GasIntegrator carrier(scene);
  constexpr std::uint64_t kSeed = 7;
  model::GasMember unbroken;
  carrier.integrate(unbroken, 0.8, kSeed, 1, [](const model::GasMember&) { return true; });
  ASSERT_EQ(unbroken.observations.size(), carrier.times().size());
  ASSERT_GT(unbroken.steps, 10U);
  for (const int asked : {1, 2, 5, 17}) {
    model::GasMember member;
    int stops = 0;
    while (member.observations.size() < carrier.times().size()) {
      int left = asked + 1;  // once before there is a step
      carrier.integrate(member, 0.8, kSeed, 1 + stops % 3,
                        [&](const model::GasMember&) { return --left > 0; });
      member = reread(member);
      ++stops;
    }
    EXPECT_GE(stops, 2);
    EXPECT_TRUE(reflection::encode(member) == reflection::encode(unbroken)) << "every " << asked;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, AGasThatGoesOn,
    ::testing::Values(Kind{"majorant", {}}, Kind{"large", {"boltzmann.particles=20000"}},
                      Kind{"sheared", {"boltzmann.shear_rate=1"}},
                      Kind{"quasi", {"boltzmann.sampling=quasi", "boltzmann.initial=equal_energy"}},
                      Kind{"literal", {"boltzmann.scheme=ogawa-kato"}},
                      Kind{"literal_quasi",
                           {"boltzmann.scheme=ogawa-kato", "boltzmann.sampling=quasi"}},
                      Kind{"without_checkpoints", {"output.checkpoint=none"}},
                      Kind{"ends_between_rows", {"boltzmann.until=1.97"}}),
    [](const auto& one) { return one.param.name; });

// --- run folders ---

/// All that a run leaves for its reader, without what depends on the clock.
std::map<std::string, std::string> content(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (extension == ".csv" || extension == ".yaml") {
      const auto bytes = testing::bytes_of(entry.path());
      files[entry.path().filename()] = std::string(bytes.begin(), bytes.end());
    }
  }
  auto json = nlohmann::json::parse(testing::bytes_of(folder / "run.json"));
  for (const char* key :
       {"wall_seconds", "step_seconds", "collisions_per_second", "threads", "ranks"}) {
    json.erase(key);
  }
  files["run.json"] = json.dump();
  return files;
}

/// Lines of log.txt without their times.
std::vector<std::string> log_lines(const fs::path& folder) {
  const auto bytes = testing::bytes_of(folder / "log.txt");
  std::vector<std::string> lines;
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line.substr(line.find(": ")));
  }
  return lines;
}

class GasResumeTest : public ::testing::Test {
 protected:
  /// Runs until an event says that it is enough.
  store::RunSummary run_until(const scene::BoltzmannScene& scene, int threads,
                              const std::function<bool(const GasProgress&)>& enough) {
    std::atomic<int> stop = 0;
    const RunEvents events = stopping(stop, enough);
    return run(scene, {.folder = folder_.path(), .threads = threads, .stop_signal = &stop}, events);
  }
  store::RunSummary resume_until(int threads,
                                 const std::function<bool(const GasProgress&)>& enough) {
    std::atomic<int> stop = 0;
    const RunEvents events = stopping(stop, enough);
    return resume(load_run(folder_.path(), kMaxBytes),
                  {.folder = {}, .threads = threads, .stop_signal = &stop}, events);
  }
  store::RunSummary resume_to(const std::optional<std::string>& until = {}) {
    return resume(load_run(folder_.path(), kMaxBytes, until), {.folder = {}, .threads = 1});
  }
  std::string problem(const std::optional<std::string>& until = {}) {
    try {
      resume_to(until);
    } catch (const store::StoreError& error) {
      return error.what();
    }
    return "none";
  }
  void expect_as_unbroken(const scene::BoltzmannScene& scene) {
    const testing::ScratchFolder whole;
    const auto expected = run(scene, {.folder = whole.path(), .threads = 2});
    EXPECT_EQ(expected.status, "done");
    EXPECT_EQ(content(folder_.path()), content(whole.path()));
  }

  testing::ScratchFolder folder_;

 private:
  static RunEvents stopping(std::atomic<int>& stop,
                            const std::function<bool(const GasProgress&)>& enough) {
    return {.gas_progress =
                [&stop, enough](const GasProgress& progress) {
                  stop = stop != 0 || enough(progress) ? 2 : 0;
                },
            .progress_interval = {}};
  }
};

/// Long enough for several threads to have a gas each, and more gases than threads: when the first
/// is done, others are not.
const Overrides kLong = {"boltzmann.particles=2000",       "boltzmann.until=100",
                         "boltzmann.restitution=[0.8, 1]", "boltzmann.friction=0",
                         "boltzmann.ensemble=5",           "output.series.every=4",
                         "output.histograms=[0, 10]"};

TEST_F(GasResumeTest, StoppedInAnyEnsembleItEndsAsAnUnbrokenRun) {
  const scene::BoltzmannScene scene = gas(kLong);
  ASSERT_EQ(run_until(scene, 1, [](const GasProgress& at) { return at.time > 0; }).status,
            "interrupted");
  ASSERT_EQ(resume_until(3, [](const GasProgress& at) { return at.stage_number == 2; }).status,
            "interrupted");
  const auto interrupted = content(folder_.path());
  // Stopped before the first step of this process: all as it was.
  ASSERT_EQ(resume(load_run(folder_.path(), kMaxBytes),
                   {.folder = {}, .threads = 2, .wall_seconds_limit = 0})
                .status,
            "interrupted");
  EXPECT_EQ(content(folder_.path()), interrupted);
  EXPECT_EQ(resume_to().status, "done");
  expect_as_unbroken(scene);
}

TEST_F(GasResumeTest, StoppedAndResumedBySeveralRanksItEndsAsARunOfOneProcess) {
  Overrides more = kLong;
  more.insert(more.end(),
              {"boltzmann.until=40", "boltzmann.ensemble=8"});  // as the ranks are three
  const scene::BoltzmannScene scene = gas(more);
  testing::ThreadRanks all(3);
  const auto with_others = [&](const std::function<store::RunSummary(tasks::Ranks&)>& lead) {
    std::vector<std::thread> others;
    for (const int number : {1, 2}) {
      others.emplace_back([&, number] {
        const auto mine = all.seen_from(number);
        work_for_rank_0({.threads = 1, .ranks = mine.get()});
      });
    }
    const auto first = all.seen_from(0);
    const store::RunSummary summary = lead(*first);
    first->dismiss();
    for (std::thread& other : others) {
      other.join();
    }
    return summary;
  };
  std::atomic<int> stop = 0;
  const RunEvents stopping = {
      .gas_progress = [&](const GasProgress& at) { stop = at.stage_number == 2 ? 2 : 0; },
      .progress_interval = {}};
  const auto first = with_others([&](tasks::Ranks& ranks) {
    return run(scene, {.folder = folder_.path(), .stop_signal = &stop, .ranks = &ranks}, stopping);
  });
  ASSERT_EQ(first.status, "interrupted");
  const auto second = with_others([&](tasks::Ranks& ranks) {
    return resume(load_run(folder_.path(), kMaxBytes), {.folder = {}, .ranks = &ranks});
  });
  EXPECT_EQ(second.status, "done");
  expect_as_unbroken(scene);
}

TEST_F(GasResumeTest, TheLogTellsOfEachRestitutionOnce) {
  const scene::BoltzmannScene scene = gas(kLong);
  run_until(scene, 1, [](const GasProgress& at) { return at.stage_number == 2; });
  resume_to();
  const testing::ScratchFolder whole;
  run(scene, {.folder = whole.path()});
  EXPECT_EQ(log_lines(folder_.path()), log_lines(whole.path()));
  EXPECT_EQ(log_lines(folder_.path()).size(), 2U);
}

// A checkpoint after each step, by a clock that is always due; the newest is taken aside while the
// run goes on, as it would lie there after a kill. Again if the run was over before its disk.
TEST_F(GasResumeTest, KilledItGoesOnFromWhatItSavedOnTheWay) {
  for (const int threads : {1, 3}) {
    const scene::BoltzmannScene scene =
        gas({"boltzmann.restitution=[0.8, 1]", "boltzmann.friction=0", "boltzmann.ensemble=2",
             "output.checkpoint={seconds: 0.000001}"});
    const testing::ScratchFolder aside;
    bool taken = false;
    const RunEvents events = {.gas_progress =
                                  [&](const GasProgress&) {
                                    const fs::path saved = folder_.path() / "checkpoint.clca";
                                    std::error_code none_yet;
                                    taken |= fs::copy_file(saved, aside.path() / "checkpoint.clca",
                                                           fs::copy_options::overwrite_existing,
                                                           none_yet);
                                  },
                              .progress_interval = {}};
    while (!taken) {
      EXPECT_EQ(run(scene, {.folder = folder_.path(), .threads = threads}, events).status, "done");
    }
    fs::copy_file(aside.path() / "checkpoint.clca", folder_.path() / "checkpoint.clca",
                  fs::copy_options::overwrite_existing);
    fs::remove(folder_.path() / "checkpoint-previous.clca");
    fs::remove(folder_.path() / "run.json");
    resume_to();
    expect_as_unbroken(scene);
  }
}

TEST_F(GasResumeTest, KilledBeforeItsFirstCheckpointItBeginsAnew) {
  const scene::BoltzmannScene scene = gas();
  run(scene, {.folder = folder_.path()});
  fs::remove(folder_.path() / "run.json");
  store::Checkpoint start = store::read_checkpoint(folder_.path(), kMaxBytes)->checkpoint;
  start.fields.clear();
  store::write_checkpoint(store::OutputFolder(folder_.path()), start,
                          store::PreviousCheckpoint::replaced);
  EXPECT_EQ(resume_to().status, "done");
  expect_as_unbroken(scene);
}

TEST_F(GasResumeTest, StoppedWithoutCheckpointsItSavesItselfAllTheSame) {
  Overrides overrides = kLong;
  overrides.push_back("output.checkpoint=none");
  const scene::BoltzmannScene scene = gas(overrides);
  run_until(scene, 1, [](const GasProgress& at) { return at.time > 0; });
  EXPECT_TRUE(fs::exists(folder_.path() / "checkpoint.clca"));
  resume_to();
  expect_as_unbroken(scene);
}

TEST_F(GasResumeTest, WhatHasEndedStaysAsItIs) {
  run(gas({"boltzmann.ensemble=2"}), {.folder = folder_.path()});
  const auto before = content(folder_.path());
  EXPECT_EQ(resume_to().status, "done");
  EXPECT_EQ(content(folder_.path()), before);
}

TEST_F(GasResumeTest, ProlongedItIsARunThatWasAsLongFromTheBeginning) {
  // The old end is a row, a histogram, neither, and a multiple that misses a row by rounding.
  const std::vector<Overrides> ends = {{"boltzmann.until=2"},
                                       {"boltzmann.until=1.97", "output.histograms=[0, 1.97]"},
                                       {"boltzmann.until=1.97"},
                                       {"boltzmann.until=1.7"},
                                       {"boltzmann.until=1.97", "boltzmann.scheme=ogawa-kato"},
                                       {"boltzmann.until=0.03", "output.histograms=[]"}};
  for (Overrides overrides : ends) {
    SCOPED_TRACE(overrides.front().text);
    overrides.insert(overrides.end(), {"boltzmann.restitution=[0.8, 1]", "boltzmann.ensemble=2"});
    run(gas(overrides), {.folder = folder_.path()});
    for (const std::string until : {"2.31", "3"}) {
      EXPECT_EQ(resume_to(until).status, "done");
      overrides.push_back("boltzmann.until=" + until);
      expect_as_unbroken(gas(overrides));
    }
  }
}

TEST_F(GasResumeTest, AnInterruptedRunIsProlongedLikewise) {
  run_until(gas(kLong), 1, [](const GasProgress& at) { return at.stage_number == 2; });
  resume_to("132");
  Overrides overrides = kLong;
  overrides.push_back("boltzmann.until=132");
  expect_as_unbroken(gas(overrides));
}

TEST_F(GasResumeTest, AnEndThatWasPassedIsRefused) {
  run(gas(), {.folder = folder_.path()});
  const auto before = content(folder_.path());
  EXPECT_THAT(problem("1"),
              HasSubstr("until 1: its gases are beyond 1, or in a step that leads beyond it"));
  EXPECT_EQ(content(folder_.path()), before);
}

TEST_F(GasResumeTest, GasesThatWereNotKeptAreNotProlonged) {
  run_until(gas(kLong), 1, [](const GasProgress& at) { return at.stage_number == 2; });
  store::Checkpoint checkpoint = store::read_checkpoint(folder_.path(), kMaxBytes)->checkpoint;
  SavedGasRun course;
  reflection::decode(kGasesPath, checkpoint.fields, kMaxBytes, course);
  for (record::GasCase& one : course.cases) {
    for (model::GasMember& member : one.members) {
      member.lasting.reset();
    }
  }
  reflection::encode(kGasesPath, course, checkpoint.fields);
  store::write_checkpoint(store::OutputFolder(folder_.path()), checkpoint);
  EXPECT_THAT(problem("500"), HasSubstr("has not kept its gases as they were before the end"));
}

// --- checkpoints that no run has saved ---

/// What somebody has changed in the course of a run that was stopped.
struct Forgery {
  std::function<void(SavedGasRun&)> change;
  const char* reason;
};

model::GasMember& under_way(SavedGasRun& course) {
  for (model::GasMember& member : course.cases.back().members) {
    if (member.gas) {
      return member;
    }
  }
  throw std::logic_error("no gas is under way");
}
model::GasMember& ended(SavedGasRun& course) {
  return course.cases.front().members.front();
}

TEST_F(GasResumeTest, ACheckpointOfNoRunIsRefusedInOneLine) {
  run_until(gas(kLong), 1,
            [](const GasProgress& at) { return at.stage_number == 2 && at.time > 0; });
  const store::Checkpoint sound = store::read_checkpoint(folder_.path(), kMaxBytes)->checkpoint;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Forgery> forgeries = {
      {[](SavedGasRun& all) { all.cases.emplace_back(); }, "restitutions are others"},
      {[](SavedGasRun& all) { all.cases.front().restitution = 0.3; }, "restitutions are others"},
      {[](SavedGasRun& all) { all.cases_ended = 3; }, "restitutions are others"},
      {[&](SavedGasRun& all) { all.wall_seconds = nan; }, "its time is not a number of 0 or more"},
      {[](SavedGasRun& all) { all.cases.front().members.pop_back(); }, "ensemble is another"},
      {[](SavedGasRun& all) { ended(all).observations.push_back({}); }, "more observations"},
      {[](SavedGasRun& all) { ended(all).observations.pop_back(); }, "a gas is missing"},
      {[](SavedGasRun& all) { ended(all).observations[0].shares.rotational.pop_back(); },
       "bins are others"},
      {[](SavedGasRun& all) { ended(all).observations[1].shares.translational = {1}; },
       "bins are others"},
      {[](SavedGasRun& all) { ended(all).gas = ended(all).lasting; }, "beyond the end"},
      {[](SavedGasRun& all) { ended(all).lasting->time = 3; }, "at another time"},
      {[](SavedGasRun& all) { under_way(all).lasting = under_way(all).gas; },
       "kept for an end that it has not reached"},
      {[](SavedGasRun& all) { under_way(all).observations.clear(); }, "at another time"},
      {[&](SavedGasRun& all) { under_way(all).gas->time = nan; }, "at another time"},
      {[](SavedGasRun& all) { under_way(all).gas->motions.resize(6, 0); }, "number of particles"},
      {[](SavedGasRun& all) { under_way(all).gas->motions.resize(6, 8001); },
       "number of particles"},
      {[&](SavedGasRun& all) { under_way(all).gas->motions(5, 77) = nan; },
       "not finite or too large"},
      {[](SavedGasRun& all) { under_way(all).gas->motions(0, 0) = 1e300; },
       "not finite or too large"},
      {[](SavedGasRun& all) { under_way(all).gas->thermal_speed = -1; },
       "not finite or too large"}};
  for (const Forgery& forgery : forgeries) {
    SavedGasRun course;
    reflection::decode(kGasesPath, sound.fields, kMaxBytes, course);
    forgery.change(course);
    store::Checkpoint forged = sound;
    reflection::encode(kGasesPath, course, forged.fields);
    fs::remove(folder_.path() / "run.json");
    store::write_checkpoint(store::OutputFolder(folder_.path()), forged);
    EXPECT_THAT(problem(), ::testing::AllOf(HasSubstr("its checkpoint is not of this run"),
                                            HasSubstr(forgery.reason)));
  }
}

TEST_F(GasResumeTest, AnyColumnThatIsMissingOrOfOtherNumbersIsRefused) {
  run(gas({"boltzmann.ensemble=2"}), {.folder = folder_.path()});
  const store::Checkpoint sound = store::read_checkpoint(folder_.path(), kMaxBytes)->checkpoint;
  ASSERT_GT(sound.fields.size(), 20U);
  fs::remove(folder_.path() / "run.json");
  for (const auto& [path, column] : sound.fields) {
    store::Checkpoint forged = sound;
    forged.fields.erase(path);
    store::write_checkpoint(store::OutputFolder(folder_.path()), forged);
    EXPECT_THAT(problem(), HasSubstr(path + " is missing"));
    forged.fields[path] = std::vector<std::int32_t>{1};
    store::write_checkpoint(store::OutputFolder(folder_.path()), forged);
    EXPECT_THAT(problem(), HasSubstr(path + " holds other numbers"));
  }
}

}  // namespace
}  // namespace clca::run::gas_resume_test
