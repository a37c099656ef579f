// Fills with a mixture, and pictures of species.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "bad_scenes.hpp"
#include "clca/image/png.hpp"
#include "clca/scene/parse.hpp"
#include "support/runs.hpp"

namespace clca::scene::fill_test {
namespace {

Scene scene_with_fill(const std::string& fill, const std::string& file = "scene.yaml") {
  return parse(testing::scene_with("stages: [{name: a, fill: {region: [0, 0, 100, 50], " + fill +
                                   "}, sources: [spout]}]"),
               file);
}

TEST(Fill, OfAMixHasOnePartAndALevel) {
  const Scene scene = scene_with_fill("method: deposition, mix: {small: 2, large: 1}, level: 30");
  const auto mixture = mixture_of(*scene.stages[0].fill);
  ASSERT_TRUE(mixture);
  EXPECT_EQ(mixture->part_weights, (std::vector<std::vector<std::uint32_t>>{{2, 1}}));
  EXPECT_TRUE(mixture->deposited);
  EXPECT_EQ(mixture->surface_level, 30);
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Fill, OfAPictureHasAPartForEachLetter) {
  const Scene scene =
      scene_with_fill("picture: {rows: [X.B, BBX], pixels: {X: large, B: {small: 1, large: 3}}}");
  const auto mixture = mixture_of(*scene.stages[0].fill);
  ASSERT_TRUE(mixture);
  EXPECT_EQ(mixture->picture_rows, (std::vector<std::string>{"B.A", "AAB"}));
  EXPECT_EQ(mixture->part_weights, (std::vector<std::vector<std::uint32_t>>{{1, 3}, {0, 1}}));
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Fill, PicturesOfAllFillsHaveABoundOfWeights) {
  std::string text = "clca: 1\nbox: {width: 60, height: 60}\nspecies:\n";
  for (int i = 0; i < 1000; ++i) {
    text += "  s" + std::to_string(i) + ": {shape: {hexagon: 1}}\n";
  }
  std::string pixels = "A: s0";
  for (char letter = 'B'; letter <= 'Z'; ++letter) {
    pixels += std::string(", ") + letter + ": s0";
  }
  text += "stages:\n";
  for (int i = 0; i < 77; ++i) {  // 77 x 26 x 1000 weights
    text += "  - {name: t" + std::to_string(i) +
            ", fill: {region: [0, 0, 9, 9], picture: {rows: [A], pixels: {" + pixels + "}}}}\n";
  }
  try {
    parse(text, "scene.yaml");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(
        error.what(),
        "scene.yaml:1081:75: error: stages.t76.fill.picture.pixels: the pictures of all fills "
        "have more than 2000000 weights, one for each part and species");
  }
}

TEST(Fill, PixelsOfAFileHaveTheNearestColourOrAreEmpty) {
  const clca::testing::ScratchFolder folder;
  image::Image picture(2, 2, {250, 250, 250});
  picture.at(0, 0) = {220, 90, 10};
  picture.at(1, 1) = {0, 100, 160};
  const std::vector<std::uint8_t> bytes = image::encode_png(picture, {});
  std::ofstream(folder.path() / "a.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  const Scene scene =
      scene_with_fill("picture: {file: a.png, colors: {\"#0072b2\": small, \"#d55e00\": large}}",
                      (folder.path() / "scene.yaml").string());
  EXPECT_EQ(scene.stages[0].fill->picture->rows, (std::vector<std::string>{"B.", ".A"}));
  // The resolved scene needs no file.
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Fill, OfAMixCountsInTheEstimateOfMemory) {
  const Scene scene = scene_with_fill("mix: {small: 1, large: 1}");
  const ModelSize size = model_size(scene);
  EXPECT_GT(size.max_particles, 100U);
  EXPECT_LT(size.max_particles, 1000U);  // of 13 sites in the mean
}

}  // namespace
}  // namespace clca::scene::fill_test
