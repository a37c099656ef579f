#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::resolve_test {

namespace {

Scene scene_with(std::string_view part) {
  return parse(testing::scene_with(part), "scene.yaml");
}

constexpr std::string_view kEverything =
    "title: 'Say \"\\\" in Köln: # {a, b}'\n"
    "box: {width: 99.9, height: 50.25, periodic: true}\n"
    "species:\n"
    "  small: {shape: {sites: [[0, 0], [-1, 1]]}, orientations: any, color: \"#01fFa0\"}\n"
    "  \"null\": {shape: {polygon: [[0, 0], [2, 0], [0, 2]]}, orientations: [60]}\n"
    "  -rod: {shape: {rod: {radius: 1, length: 3}}}\n"
    "rules: {inertia: 0.1, scatter: 1e-3, gravity: up, update_priority: [gravity, rest, inertia],"
    " ties: direction}\n"
    "walls: {left: {line: {from: [0.1, 0], to: [30, 5], thickness: 0}}, right: {box: [1, 1, 9, 9]},"
    " rock: {disc: {centre: [40.1, 3], radius: 0.7}}, drum: {ring: {centre: [70, 25], radius: "
    "9.3}}, maze: {picture: {rows: [\"#.#\", \"..#\"], box: [5, 5, 30, 25.5]}},"
    " bowl: {parts: [{arc: {centre: [70, 25], radius: 2.5, thickness: 1.1, from: -90.5, to: 33}}]}}"
    "\n"
    "sources: {spout: {region: [1, 1, 9, 9], species: {-rod: 7}, rate: 1e-6},"
    " rain: {at: [9, 9.5], rate: 3, count: 5}}\n"
    "stages:\n"
    "  - {name: first, fill: {region: [0, 0, 50, 50], counts: {\"null\": 5, small: 1}}}\n"
    "  - {name: 2, sources: [spout, rain], remove: [right], until: {discharged: 0.3}}\n"
    "  - {name: \"-3\", until: {steps: 9}}\n"
    "measure: []\n"
    "begin: {run: /a/\"b\" c, step: 12, state: \"00e4000000000a1f\"}\n"
    "output: {frames: {view: [-1, -2, 3.5, 4], drawing: lookup, caption: false}, trajectory: "
    "{every: 3}}\n";

}  // namespace

TEST(ToYaml, ParsesToTheSameScene) {
  for (const std::string_view part : {std::string_view(""), kEverything}) {
    const Scene scene = scene_with(part);
    EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
  }
}

TEST(ToYaml, ShowsEverythingThatIsGiven) {
  EXPECT_EQ(to_yaml(scene_with(kEverything)), R"(clca: 1
title: "Say \"\\\" in Köln: # {a, b}"
seed: 1
model: automaton
begin: {run: "/a/\"b\" c", step: 12, state: "00e4000000000a1f"}
box: {width: 99.9, height: 50.25, periodic: true}

species:
  small: {shape: {sites: [[0, 0], [-1, 1]]}, orientations: any, color: "#01ffa0"}
  "null": {shape: {polygon: [[0, 0], [2, 0], [0, 2]]}, orientations: [60]}
  "-rod": {shape: {rod: {radius: 1, length: 3}}, orientations: [0]}

rules:
  inertia: 0.1
  scatter: 0.001
  candidates: downward
  gravity: up
  update_priority: [gravity, rest, inertia]
  ties: direction

walls:
  left: {line: {from: [0.1, 0], to: [30, 5], thickness: 0}}
  right: {box: [1, 1, 9, 9]}
  rock: {disc: {centre: [40.1, 3], radius: 0.7}}
  drum: {ring: {centre: [70, 25], radius: 9.3, thickness: 1}}
  maze: {picture: {rows: ["#.#", "..#"], box: [5, 5, 30, 25.5]}}
  bowl: {arc: {centre: [70, 25], radius: 2.5, thickness: 1.1, from: -90.5, to: 33}}

sources:
  spout: {region: [1, 1, 9, 9], species: {"-rod": 7}, rate: 1e-06}
  rain: {at: [9, 9.5], species: {small: 1, "null": 1, "-rod": 1}, rate: 3, count: 5}

outlets:
  drain: {region: [0, 0, 50, 10]}

stages:
  - name: first
    fill: {method: random, region: [0, 0, 50, 50], counts: {small: 1, "null": 5}}
    until: settled
    max_steps: 1000000
  - name: 2
    remove: [right]
    sources: [spout, rain]
    until: {discharged: 0.3}
    max_steps: 1000000
  - name: "-3"
    until: {steps: 9}
    max_steps: 1000000

measure: []

output:
  frames:
    every: 10
    color_by: species
    layers: 8
    view: [-1, -2, 3.5, 4]
    drawing: lookup
    supersampling: 2
    caption: false
    style: screen
    overlay: none
  series: none
  fields: none
  contacts: none
  trajectory: {every: 3}
  checkpoint: {seconds: 60}
)");
}

TEST(ToYaml, ParsesToTheSameSceneForEverySceneInTheTree) {
  const auto folder = std::filesystem::path(CLCA_SOURCE_DIR) / "scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") {
      const AnyScene any = parse_any_file(entry.path());
      const std::string text = std::visit([](const auto& scene) { return to_yaml(scene); }, any);
      const AnyScene again = parse_any(text, entry.path());
      EXPECT_EQ(std::visit([](const auto& scene) { return to_yaml(scene); }, again), text);
    }
  }
}

TEST(ToYaml, ShowsEveryDefault) {
  EXPECT_EQ(to_yaml(scene_with("")), R"(clca: 1
title: "Test"
seed: 1
model: automaton
box: {width: 100, height: 50, periodic: false}

species:
  small: {shape: {hexagon: 1}, orientations: [0]}
  large: {shape: {hexagon: 2}, orientations: [0]}

rules:
  inertia: 0.9
  scatter: 0
  candidates: downward
  gravity: down
  update_priority: [rest, inertia, gravity]
  ties: particle

walls:
  left: {box: [0, 0, 1, 50]}
  right: {box: [50, 0, 51, 50]}

sources:
  spout: {at: [20, 40], species: {small: 1, large: 1}, rate: 0.5, count: 9}

outlets:
  drain: {region: [0, 0, 50, 10]}

stages:
  - name: first
    fill: {method: random, region: [0, 0, 50, 50], counts: {small: 5}}
    sources: [spout]
    until: settled
    max_steps: 1000000

measure: [profile]

output:
  frames:
    every: 10
    color_by: species
    layers: 8
    drawing: auto
    supersampling: 2
    caption: true
    style: screen
    overlay: none
  series: {every: 1}
  fields: none
  contacts: none
  trajectory: none
  checkpoint: {seconds: 60}
)");
}

TEST(Scenes, DifferWhenAnyPartDiffers) {
  const Scene scene = scene_with("");
  for (const std::string_view part :
       {"title: Other", "seed: 2", "box: {width: 100, height: 51}", "rules: {ties: direction}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {box: [50, 0, 51, 49]}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {line: {from: [50, 0], to: [50, 50]}}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {disc: {centre: [50, 0], radius: 3}}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {ring: {centre: [50, 0], radius: 3}}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {ring: {centre: [50, 0], radius: 3, "
        "thickness: 2}}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {arc: {centre: [50, 0], radius: 3, from: 0, "
        "to: 90}}}",
        "walls: {left: {box: [0, 0, 1, 50]}, right: {arc: {centre: [50, 0], radius: 3, from: 0, "
        "to: 91}}}",
        "measure: [repose]", "output: {frames: {every: 11}, series: {every: 1}}",
        "output: {frames: {every: 10}, series: {every: 1}, trajectory: {every: 10}}"}) {
    EXPECT_NE(to_yaml(scene_with(part)), to_yaml(scene)) << part;
  }
}

TEST(SizeOf, CountsSitesAndParticles) {
  const ModelSize size = model_size(scene_with(""));
  EXPECT_EQ(size.columns, 116);  // 100 / 0.866 = 115.5
  EXPECT_EQ(size.rows, 50);
  EXPECT_EQ(size.max_particles, 14);
}

TEST(SizeOf, BoundsASourceThatNeverEndsByTheStepsOfItsStages) {
  const ModelSize size =
      model_size(scene_with("sources: {spout: {at: [20, 40], rate: 0.25}}\n"
                            "stages:\n"
                            "  - {name: first, sources: [spout], until: {steps: 1000}}\n"
                            "  - {name: second}\n"
                            "  - {name: third, sources: [spout], max_steps: 201}\n"));
  EXPECT_EQ(size.max_particles, 301);  // 1201 / 4 = 300.25
}

TEST(SizeOf, BoundsParticlesThatCannotLeaveByTheSitesOfTheBox) {
  const ModelSize size =
      model_size(scene_with("sources: {spout: {at: [20, 40], rate: 1000}}\noutlets: {}\n"
                            "stages: [{name: first, sources: [spout], max_steps: 1000000}]"));
  EXPECT_EQ(size.max_particles, 116U * 50U);
}

TEST(SizeOf, GrowsWithBoxParticlesAndFill) {
  const double least = model_size(scene_with("output: {}")).memory_bytes;
  EXPECT_GT(model_size(scene_with("output: {}\nbox: {width: 200, height: 50}")).memory_bytes,
            least + 2e4);
  EXPECT_GE(model_size(scene_with("output: {}\nsources: {spout: {at: [20, 40], rate: 1, count: "
                                  "1009}}"))
                .memory_bytes,
            least + 1000.0 * 130);
}

TEST(SizeOf, CountsShapesAndRegionsOfSources) {
  const auto bytes = [](const std::string& part) {
    return model_size(scene_with(part)).memory_bytes;
  };
  EXPECT_GE(bytes("species: {small: {shape: {hexagon: 100}, orientations: any}}"),
            bytes("species: {small: {shape: {hexagon: 1}}}") + 30'301.0 * (8 + 6 * 24));
  EXPECT_GE(bytes("sources: {spout: {region: [0, 0, 100, 50], rate: 0.5, count: 9}}"),
            bytes("sources: {spout: {at: [20, 40], rate: 0.5, count: 9}}") + 116.0 * 50 * 8);
}

TEST(SizeOf, HoldsForTheLargestBox) {
  const ModelSize size = model_size(scene_with("box: {width: 866025, height: 1000000}"));
  EXPECT_EQ(size.columns, 1'000'000);
  EXPECT_EQ(size.rows, 1'000'000);
  EXPECT_GT(size.memory_bytes, 4e12);
}

}  // namespace clca::scene::resolve_test
