// Damaged scenes: whatever stands in a file, the answer is a scene or one clear line.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "bad_scenes.hpp"
#include "support/any_text.hpp"

namespace clca::scene::mutation_test {

namespace {

using namespace std::string_view_literals;

std::string trouble_with(const std::string& text) {
  return clca::testing::trouble_with_text(text);
}

/// Numbers that look random and are the same everywhere (Numerical Recipes' generator).
class Numbers {
 public:
  std::size_t below(std::size_t bound) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8U) % bound;
  }

 private:
  std::uint32_t state_ = 1;
};

std::string block_scene() {
  return testing::scene_with(
      "title: \"a 'quoted' \\\" title\"  # and a comment\n"
      "species:\n"
      "  small:\n"
      "    shape: {sites: [[0, 0], [0, 1], [1, 0]]}\n"
      "    color: '#ff0000'\n"
      "stages:\n"
      "  - name: first\n"
      "    sources: [spout]\n"
      "    until: {steps: 5}\n"
      "  - name: second\n"
      "    remove:\n"
      "      - right\n");
}

std::string moving_scene() {
  return testing::scene_with(
      "walls:\n"
      "  tray: {parts: [{box: [0, 0, 9, 2]}, {line: {from: [0, 2], to: [0, 60]}}],\n"
      "         motion: {shake: {amplitude: 2, wait: 5}}, passive: overlap}\n"
      "  lid: {box: [10, 60, 20, 90], motion: {direction: down, period: 4, distance: 20}}\n"
      "  ram: {box: [30, 40, 40, 42], motion: {path: [[3, 1], [9, -5]]}}\n"
      "  comb: {box: [60, 40, 70, 42], motion: {wave: {form: triangle, amplitude: 2, period: 8}}}\n"
      "stages:\n"
      "  - {name: first, sources: [spout], insert: [lid], move: [tray, lid], until: {cycles: 3}}\n"
      "  - {name: second, remove: [lid], move: [comb, ram], until: {cycles: 2}, max_steps: 99}\n"
      "output: {frames: {color_by: force, overlay: arrows}, fields: {cell: 2}, contacts: {}}\n");
}

std::string contact_scene() {
  return testing::contact_with(
      "contact: {friction: 0.2, wall_friction: 16384, rolling: free, restitution: 0.99, sweeps: "
      "4,\n"
      "          resolution: 0.05, fall_height: auto}\n"
      "walls: {left: {box: [0, 0, 1, 50], friction: 0}}\n"
      "measure: [moved]\n");
}

std::string gas_scene() {
  return testing::gas_with(
      "boltzmann:\n"
      "  restitution: [0.5, 0.9]\n"
      "  roughness: -0.5\n"
      "  scheme: ogawa-kato\n"
      "  partners: 3\n"
      "  until: 9\n"
      "output: {series: {every: 2}, histograms: [0, 1.5, 9], bins: {width: 0.5, end: 15}}\n");
}

std::vector<std::string> scenes() {
  return {testing::small_scene(), block_scene(),        moving_scene(),
          contact_scene(),        testing::small_gas(), gas_scene()};
}

}  // namespace

TEST(DamagedScene, CutAnywhereIsASceneOrOneLine) {
  for (const std::string& text : scenes()) {
    ASSERT_NO_THROW(parse_any(text, "scene.yaml"));
    for (std::size_t length = 0; length < text.size(); ++length) {
      ASSERT_EQ(trouble_with(text.substr(0, length)), "") << text.substr(0, length);
    }
  }
}

TEST(DamagedScene, WithOneByteChangedIsASceneOrOneLine) {
  constexpr std::string_view kNasty = "\0\t\n\r \"'#&*!|>%@`{}[],:-?~.<09aZ\x80\xC3\xFF"sv;
  Numbers numbers;
  for (const std::string& text : scenes()) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      for (int kind = 0; kind < 4; ++kind) {
        std::string damaged = text;
        const char byte = kind == 0 ? static_cast<char>(numbers.below(256))
                                    : kNasty[numbers.below(kNasty.size())];
        if (kind == 3) {
          damaged.insert(i, 1, byte);
        } else {
          damaged[i] = byte;
        }
        ASSERT_EQ(trouble_with(damaged), "") << damaged;
      }
    }
  }
}

TEST(DamagedScene, WithAPieceMovedIsASceneOrOneLine) {
  Numbers numbers;
  for (std::size_t round = 0; round < 5000; ++round) {
    std::string text = scenes()[round % 6];
    const std::size_t from = numbers.below(text.size());
    const std::string piece = text.substr(from, 1 + numbers.below(30));
    text.erase(from, piece.size());
    text.insert(numbers.below(text.size()), piece);
    ASSERT_EQ(trouble_with(text), "") << text;
  }
}

}  // namespace clca::scene::mutation_test
