#pragma once
// A short run of the contact model with all that it can write.

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "clca/scene/parse.hpp"
#include "support/runs.hpp"

namespace clca::run {

inline constexpr double kMuch = 1e9;  ///< bytes

inline constexpr const char* kSmall = R"(clca: 1
model: contact
seed: 3
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [20, 0, 21, 60], friction: 0.1}}
sources: {spout: {region: [4, 50, 12, 54], species: {grain: 1}, rate: 0.05, count: 4}}
outlets: {drain: {region: [22, 0, 41, 8]}}
probes: {gap: [20, 0, 40, 30]}
lines: {gate: {from: [20, 0], to: [20, 30], parts: 6}, brink: {from: [0, 8.2], to: [40, 8.2]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 60], counts: {grain: 40}}
    until: {steps: 300}
  - name: flow
    remove: [gate]
    sources: [spout]
    until: {steps: 300}
measure: [profile, packing, moved, outflow, force]
output:
  frames: {every: 100, width: 96, height: 64, color_by: force, overlay: forces}
  series: {every: 1}
  trajectory: {every: 10}
  checkpoint: {every: 50}
)";

class ContactRuns : public ::testing::Test {
 protected:
  static scene::Scene small(const std::vector<scene::Override>& overrides = {}) {
    return scene::parse(kSmall, "small.yaml", overrides);
  }
  std::filesystem::path path(const char* name = "run") const { return folder.path() / name; }

  testing::ScratchFolder folder;
};

}  // namespace clca::run
