#pragma once
// Scenes whose runs are drawn again.

#include <string>

namespace clca::drawing {

/// Two stages, two species, a wall that is removed, an outlet and a source that drains into it.
inline const std::string kDrained = R"(clca: 1
title: Drained
box: {width: 60, height: 70}
species:
  small: {shape: {hexagon: 1}}
  rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}
walls:
  gate: {box: [30, 0, 31, 60]}
sources:
  tap: {at: [15, 60], rate: 0.3}
outlets:
  drain: {region: [45, 0, 60, 12]}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 45], counts: {small: 60, rod: 40}}
  - {name: flow, remove: [gate], until: {steps: 60}}
  - {name: tapped, sources: [tap], until: {steps: 60}}
output: {frames: {every: 10, width: 200, height: 160, supersampling: 1}}
)";

/// A column of grains that falls, and lies on the floor from some step on.
inline const std::string kFalling = R"(clca: 1
box: {width: 20, height: 60}
species: {grain: {shape: {hexagon: 1}, color: "#102030"}}
walls: {table: {box: [0, 8, 20, 9]}}
stages:
  - {name: fall, fill: {region: [5, 40, 14, 60], counts: {grain: 6}}, until: {steps: 60}}
  - {name: again, remove: [table], until: {steps: 40}}
output: {frames: {width: 100, height: 60, caption: false}, trajectory: {every: 7}}
)";

}  // namespace clca::drawing
