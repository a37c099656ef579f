#include "bad_scenes.hpp"

#include <algorithm>
#include <sstream>

#include "clca/scene/parse.hpp"

namespace clca::scene::testing {

namespace {

/// A key at the top and its lines.
struct Block {
  std::string key;
  std::string lines;
};

std::vector<Block> blocks_of(std::string_view text) {
  std::vector<Block> blocks;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    if (line.front() != ' ') {
      blocks.push_back({line.substr(0, line.find(':')), ""});
    }
    blocks.back().lines += line + '\n';
  }
  return blocks;
}

std::string text_with(const std::string& whole, std::string_view part) {
  std::vector<Block> scene = blocks_of(whole);
  for (Block& block : blocks_of(part)) {
    const auto old = std::find_if(scene.begin(), scene.end(),
                                  [&](const Block& other) { return other.key == block.key; });
    if (old == scene.end()) {
      scene.push_back(std::move(block));
    } else {
      *old = std::move(block);
    }
  }
  std::string text;
  for (const Block& block : scene) {
    text += block.lines;
  }
  return text;
}

}  // namespace

std::vector<BadText> bad_scenes() {
  std::vector<BadText> all;
  for (const auto& some :
       {bad_basics(), bad_species(), bad_geometry(), bad_motion(), bad_stages(), bad_journeys()}) {
    for (const BadScene& bad : some) {
      all.push_back({bad.what, scene_with(bad.part), bad.message, bad.judge});
    }
  }
  for (const BadScene& bad : bad_contacts()) {
    all.push_back({bad.what, contact_with(bad.part), bad.message, bad.judge});
  }
  for (const auto& some : {bad_gases(), bad_gas_outputs()}) {
    for (const BadScene& bad : some) {
      all.push_back({bad.what, gas_with(bad.part), bad.message, bad.judge});
    }
  }
  return all;
}

std::string small_scene() {
  return R"(clca: 1
title: Test
seed: 1
box: {width: 100, height: 50}
species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
rules: {inertia: 0.9}
walls: {left: {box: [0, 0, 1, 50]}, right: {box: [50, 0, 51, 50]}}
sources: {spout: {at: [20, 40], rate: 0.5, count: 9}}
outlets: {drain: {region: [0, 0, 50, 10]}}
stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 5}}, sources: [spout]}]
measure: [profile]
output: {frames: {every: 10}, series: {every: 1}}
)";
}

std::string small_contact() {
  std::string text = small_scene();
  constexpr std::string_view kRules = "rules: {inertia: 0.9}";
  return text.replace(text.find(kRules), kRules.size(), "model: contact");
}

std::string small_gas() {
  return R"(clca: 1
title: Test
seed: 1
boltzmann: {restitution: 0.5, friction: 0.3}
output: {series: {every: 0.5}}
)";
}

std::string scene_with(std::string_view part) {
  return text_with(small_scene(), part);
}

std::string contact_with(std::string_view part) {
  return text_with(small_contact(), part);
}

std::string gas_with(std::string_view part) {
  return text_with(small_gas(), part);
}

std::string reparsed(const Scene& scene) {
  return to_yaml(parse(to_yaml(scene), "scene.yaml"));
}

}  // namespace clca::scene::testing
