// Random scenes of both models: what the tables of a run say of grains, sites and energy adds up.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "clca/store/table.hpp"
#include "property/random_motions.hpp"
#include "support/runs.hpp"

namespace clca::balances_test {
namespace {

using testing::within;

constexpr int kSmallSites = 7;
constexpr int kLargeSites = 19;

std::string any_region(int low, int high) {
  const int left = within(0, 30);
  const int bottom = within(low, high);
  return fmt::format("[{}, {}, {}, {}]", left, bottom, left + within(8, 25),
                     bottom + within(8, 20));
}

std::string any_stage(bool contact, int number) {
  std::string text = fmt::format("  - {{name: s{}, until: {{steps: {}}}", number, within(30, 120));
  if (number == 0 || within(0, 3) > 0) {  // perhaps into an outlet
    text += fmt::format(", fill: {{region: [0, 0, 50, 80], counts: {{small: {}, large: {}}}}}",
                        within(1, 30), within(1, 15));
  }
  if (number == 1) {
    text += ", remove: [gate]";
  }
  text += number == 0 ? *rc::gen::element(", sources: [spout]", "") : ", sources: [spout]";
  text += number == 0 ? *rc::gen::element(", move: [plate]", "") : ", move: [plate]";
  if (contact) {
    text += *rc::gen::element<std::string>(
        ", vessel: {tilt: 0}", ", vessel: {rotate: {rate: 0.01, centre: [25, 40]}}",
        ", vessel: {tilt: 30}", ", vessel: {tilt: {to: 40, rate: 0.5}}",
        ", vessel: {shake: {gamma: 2, amplitude: 3}}");
  }
  return text + "}\n";
}

/// A scene with everything that grains exchange something with; not all of it in each stage.
std::string any_scene(bool contact) {
  std::string text =
      fmt::format(R"(clca: 1
model: {}
seed: {}
box: {{width: 50, height: 80}}
species: {{small: {{shape: {{hexagon: 1}}}}, large: {{shape: {{hexagon: 2}}}}}}
walls:
  gate: {{box: [20, 40, 22, {}]}}
  plate: {{box: [10, 10, 40, 12], motion: {{direction: up, {}}}}}
sources: {{spout: {{region: [5, 60, 45, 78], species: {{small: 2, large: 1}}, rate: 0.{}}}}}
outlets: {{a: {{region: {}}}, b: {{region: {}}}}}
measure: [outflow]
output: {{series: {{every: 1}}}}
stages:
)",
                  contact ? "contact" : "automaton", within(1, 1000), within(45, 80),
                  *rc::gen::element("period: 12, distance: 9", "wave: {amplitude: 2, period: 60}"),
                  within(1, 10), any_region(0, 20), any_region(0, 60));
  const int stages = within(2, 4);
  for (int i = 0; i < stages; ++i) {
    text += any_stage(contact, i);
  }
  return text;
}

struct Run {
  store::RunSummary summary;
  store::ParsedTable series;

  std::vector<double> column(const std::string& name) const { return series.column_numbers(name); }
  double last(const std::string& name) const { return column(name).back(); }
  double sum_over_stages(const std::string& name) const {
    double sum = 0;
    for (const store::StageSummary& stage : summary.stages) {
      sum += testing::measure_of(summary, stage.name, name);
    }
    return sum;
  }
};

Run any_run(bool contact) {
  const testing::ScratchFolder folder;
  const std::string text = any_scene(contact);
  RC_LOG() << text;
  const scene::Scene scene = scene::parse(text, "scene.yaml");
  Run result;
  try {
    result.summary = run::run(scene, {.folder = folder.path()});
  } catch (const scene::SceneError&) {
    RC_DISCARD("a fill does not fit");
  }
  result.series = store::read_table(folder.path() / "series.csv");
  return result;
}

void check_grains(const Run& run) {
  RC_ASSERT(run.last("particles") + run.last("discharged_particles") ==
            static_cast<double>(run.summary.particles));
  double particles = 0;
  double sites = 0;
  for (const std::string outlet : {"discharged.a", "discharged.b"}) {
    const double small = run.last(outlet + ".small");
    const double large = run.last(outlet + ".large");
    RC_ASSERT(run.last(outlet) == small + large);
    RC_ASSERT(run.sum_over_stages(outlet) == small + large);
    RC_ASSERT(run.sum_over_stages(outlet + ".small") == small);
    RC_ASSERT(run.sum_over_stages(outlet + ".large") == large);
    particles += small + large;
    sites += kSmallSites * small + kLargeSites * large;
  }
  RC_ASSERT(run.last("discharged_particles") == particles);
  RC_ASSERT(run.last("discharged_sites") == sites);
  RC_ASSERT(run.sum_over_stages("discharged") == particles);
}

RC_GTEST_PROP(BalanceProperty, GrainsAndSitesOfAnAutomatonAddUp, ()) {
  check_grains(any_run(false));
}

// What the table says of the exchange of energy is right if no energy comes from nowhere: half a
// percent is for what sites cost, as in contact_energy_test. The largest seen in 1,200 scenes was
// 0.18 %, of the energy at the start of the stage, the kinetic one or the exchanged one. The plate
// has room: a wall that jams grains throws them when they come free.
RC_GTEST_PROP(BalanceProperty, GrainsSitesAndEnergyOfTheContactModelAddUp, ()) {
  const Run run = any_run(true);
  check_grains(run);
  const auto kinetic = run.column("kinetic_energy");
  const auto potential = run.column("potential_energy");
  const auto dissipated = run.column("dissipated_energy");
  const auto source = run.column("source_energy");
  const auto outlet = run.column("outlet_energy");
  const auto walls = run.column("wall_work");
  const auto vessel = run.column("vessel_work");
  const auto stages = *run.series.find_column("stage");
  std::size_t first = 0;
  double scale = 0;
  for (std::size_t row = 0; row < kinetic.size(); ++row) {
    if (stages[row] != stages[first]) {
      first = row;
      scale = 0;
    }
    const auto start = [&](std::size_t at) {
      return kinetic[at] + potential[at] + dissipated[at] + outlet[at] - source[at] - walls[at] -
             vessel[at];
    };
    scale = std::max({scale, kinetic[row], std::abs(source[row]), std::abs(walls[row]),
                      std::abs(vessel[row]), std::abs(start(first))});
    RC_ASSERT(std::abs(start(row) - start(first)) <= 1e-9 * scale);
    RC_ASSERT(dissipated[row] >= -0.005 * scale);
  }
}

}  // namespace
}  // namespace clca::balances_test
