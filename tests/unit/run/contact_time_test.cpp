// Time in runs of the contact model: units, free fall, ends by time, and what shows it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "clca/image/png.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "contact_runs.hpp"
#include "run/saved.hpp"
#include "support/run_folders.hpp"

namespace clca::run::contact_time_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

using ContactTimeTest = ContactRuns;

TEST_F(ContactTimeTest, UnitsChangeNoStateAndScaleTimesAndVelocities) {
  const std::vector<scene::Override> fields = {
      "output.fields={cell: 10, every: 100}",
      "lines={gate: {from: [20, 0], to: [20, 10], parts: 1}}"};
  auto with_units = fields;
  with_units.emplace_back("units={spacing: 2 mm, gravity: 5}");
  const auto plain = run(small(fields), {.folder = path("plain")});
  const auto real = run(small(with_units), {.folder = path("real")});
  EXPECT_EQ(real.state_hash, plain.state_hash);
  const double second = std::sqrt(0.002 / 5);  // for one √(spacing/gravity)
  const double speed = std::sqrt(0.002 * 5);   // for one √(spacing·gravity)
  const auto expect_scaled = [&](const char* table, const char* column, double factor) {
    const auto before = testing::csv_column(path("plain") / table, column);
    const auto after = testing::csv_column(path("real") / table, column);
    ASSERT_EQ(after.size(), before.size());
    EXPECT_GT(*std::max_element(before.begin(), before.end()), 0) << column;
    for (std::size_t row = 0; row < before.size(); ++row) {
      EXPECT_NEAR(after[row], factor * before[row], 1e-12 * std::abs(after[row])) << column;
    }
  };
  expect_scaled("series.csv", "step", 1);
  expect_scaled("series.csv", "time", second);
  expect_scaled("series.csv", "mean_height", 1);
  expect_scaled("series.csv", "kinetic_energy", 1);
  expect_scaled("fields.csv", "step", 1);
  expect_scaled("fields.csv", "time", second);
  expect_scaled("fields.csv", "vx", speed);
  expect_scaled("fields.csv", "fluctuation", speed * speed);
  const auto particles = testing::csv_column(path("plain") / "fields.csv", "particles");
  const auto alone = std::count(particles.begin(), particles.end(), 0);
  EXPECT_GT(alone, 0) << "cells with the sites of a particle and the centre of none";
  EXPECT_EQ(testing::csv_column(path("plain") / "fields.csv", "vx").size(),
            particles.size() - static_cast<std::size_t>(alone));
  expect_scaled("lines-flow.csv", "flux", 1);
  expect_scaled("lines-flow.csv", "v_across", speed);
  expect_scaled("lines-flow.csv", "v_along_se", speed);
  const auto measure = [](const store::RunSummary& summary, const char* name) {
    return testing::measure_of(summary, "flow", name);
  };
  EXPECT_EQ(measure(real, "outflow_sites_per_step"), measure(plain, "outflow_sites_per_step"));
  EXPECT_GT(measure(plain, "outflow_sites_per_time"), 0);
  EXPECT_NEAR(measure(real, "outflow_sites_per_time"),
              measure(plain, "outflow_sites_per_time") / second, 1e-9);
  EXPECT_NEAR(measure(plain, "outflow_sites_per_time"),
              measure(plain, "outflow_sites_per_step") / plain.units->time_step, 1e-12);
  EXPECT_NEAR(measure(real, "fluctuation_energy"),
              measure(plain, "fluctuation_energy") * speed * speed, 1e-12);
}

// s = g t²/2; the tolerance of a step is what rounding up and the two steps at rest cost.
TEST_F(ContactTimeTest, AGrainFallsFreelyForTheSecondsOfNewton) {
  const scene::Scene fall = scene::parse(R"(clca: 1
model: contact
box: {width: 20, height: 420}
species: {grain: {shape: {hexagon: 1}}}
contact: {fall_height: 400}
units: {spacing: 1 cm}
stages:
  - name: fall
    fill: {region: [8, 408, 12, 414], counts: {grain: 1}}
    until: {time: 0.9}
output: {series: {}, fields: {cell: 1000, every: 50}}
)",
                                         "fall.yaml");
  const auto summary = run(fall, {.folder = path()});
  constexpr double kGravity = 9.81;
  const double time_step = summary.units->time_step;
  const auto time = testing::csv_column(path() / "series.csv", "time");
  const auto potential = testing::csv_column(path() / "series.csv", "potential_energy");
  const auto kinetic = testing::csv_column(path() / "series.csv", "kinetic_energy");
  EXPECT_NEAR(time.back(), 0.9, time_step);
  constexpr double kSites = 7;
  const auto fallen = [&](std::size_t row) {  // metres
    return (potential.front() - potential[row]) / kSites * 0.01;
  };
  for (const double height : {0.1, 0.5, 1.0, 2.0, 3.5}) {
    std::size_t row = 0;
    while (fallen(row) < height) {
      ASSERT_LT(++row, time.size());
    }
    EXPECT_NEAR(time[row], std::sqrt(2 * height / kGravity), 1.5 * time_step) << height;
    EXPECT_NEAR(kinetic[row], potential.front() - potential[row], 0.05 * kinetic[row]) << height;
  }
  const auto end = testing::csv_column(path() / "fields.csv", "time");
  const auto velocity = testing::csv_column(path() / "fields.csv", "vy");
  ASSERT_GT(end.size(), 3U);
  for (std::size_t window = 0; window + 1 < end.size(); ++window) {  // the last one is shorter
    const double middle = end[window] - 25 * time_step;
    EXPECT_NEAR(velocity[window], -kGravity * middle, 0.01 / (50 * time_step)) << window;
  }
}

TEST_F(ContactTimeTest, AStageUntilATimeTakesItsStepsAndGoesOnToALaterOne) {
  const auto timed = [&](const std::string& time) {
    return small({"units={spacing: 1 mm}", "stages.flow.until={time: " + time + "}"});
  };
  const auto first = run(timed("0.1"), {.folder = path()});
  EXPECT_EQ(first.stages[1].end_reason, "time");
  EXPECT_EQ(first.stages[1].steps, *scene::fixed_steps(timed("0.1").stages[1].until));
  EXPECT_THAT([&] { resume(load_run(path(), kMuch, "{time: 0.05}"), {}); },
              ::testing::ThrowsMessage<scene::SceneError>(HasSubstr("has passed this end")));
  const auto later = resume(load_run(path(), kMuch, "{time: 0.2}"), {});
  EXPECT_EQ(later.state_hash, run(timed("0.2"), {.folder = path("at once")}).state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("at once"), path()), "");
}

TEST_F(ContactTimeTest, PicturesAndProgressSayTheTime) {
  std::string last;
  const RunEvents events = {.progress = [&](const Progress& at) { last = at.time_text; },
                            .progress_interval = {}};
  const auto summary = run(small({"units={spacing: 1 mm}"}), {.folder = path()}, events);
  EXPECT_EQ(last, summary.units->time_text(600));
  EXPECT_THAT(last, EndsWith(" s"));
  const auto text = image::decode_png(testing::bytes_of(path() / "frames/small-000600.png")).text;
  EXPECT_EQ(text.at("Time"), last);
  EXPECT_EQ(text.at("Step"), "600");
}

}  // namespace
}  // namespace clca::run::contact_time_test
