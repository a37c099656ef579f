// Species whose sizes follow a law.

#include "scene/sizes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"

namespace clca::scene::sizes_test {
namespace {

lattice::Shape shape_of(const SizeClass& one) {
  if (const auto* disc = std::get_if<DiscSpec>(&one.shape)) {
    return lattice::Shape::disc(disc->radius);
  }
  return lattice::Shape::hexagon(std::get<HexagonSpec>(one.shape).radius);
}

struct Moments {
  double mean = 0;
  double sd = 0;
};

/// Of the diameters, by number or by area.
Moments moments_of(const std::vector<SizeClass>& classes, bool by_area) {
  double all = 0;
  double sum = 0;
  double squares = 0;
  for (const SizeClass& one : classes) {
    const lattice::Shape shape = shape_of(one);
    const double weight = one.share * (by_area ? static_cast<double>(shape.size()) : 1);
    all += weight;
    sum += weight * shape.diameter();
    squares += weight * shape.diameter() * shape.diameter();
  }
  return {sum / all, std::sqrt(squares / all - sum * sum / all / all)};
}

// What kinds of particles there are limits how near they come to a law; classes cut its ends.
TEST(Sizes, HaveTheMeanAndSpreadOfTheirLaw) {
  for (const SizeLaw law : {SizeLaw::uniform, SizeLaw::lognormal}) {
    for (const SharesBy by : {SharesBy::number, SharesBy::area}) {
      const Sizes sizes = {.law = law,
                           .mean = 20,
                           .sd = 5,
                           .by = by,
                           .kinds = 12,
                           .diameters = {},
                           .shares = {},
                           .shape = RoundShape::disc};
      const Moments found = moments_of(size_classes(sizes), by == SharesBy::area);
      EXPECT_NEAR(found.mean, 20, 0.2);
      EXPECT_NEAR(found.sd, 5, 0.3);
    }
  }
}

TEST(Sizes, OfFewHexagonsHaveTheMeanOfTheirLaw) {
  for (const double sd : {0.6, 1.8}) {
    for (const std::uint64_t kinds : {1U, 4U, 8U, 64U}) {
      const Sizes sizes = {.law = SizeLaw::lognormal,
                           .mean = 6,
                           .sd = sd,
                           .by = SharesBy::number,
                           .kinds = kinds,
                           .diameters = {},
                           .shares = {},
                           .shape = RoundShape::hexagon};
      EXPECT_NEAR(moments_of(size_classes(sizes), false).mean, 6, 0.03) << sd << " " << kinds;
    }
  }
}

TEST(Sizes, OfAListAreThoseNearestToIt) {
  const Sizes sizes = {.law = SizeLaw::list,
                       .mean = {},
                       .sd = {},
                       .by = SharesBy::area,
                       .kinds = 8,
                       .diameters = {2.8, 4.6, 4.5},
                       .shares = {7, 10, 9},
                       .shape = RoundShape::hexagon};
  const std::vector<SizeClass> classes = size_classes(sizes);
  ASSERT_EQ(classes.size(), 2U);  // 7 and 19 sites
  EXPECT_EQ(classes[0].shape, ShapeSpec(HexagonSpec{1}));
  EXPECT_EQ(classes[1].shape, ShapeSpec(HexagonSpec{2}));
  EXPECT_NEAR(classes[0].share, 0.5, 1e-9);
}

TEST(Sizes, DiscsOfDifferentSizesDiffer) {
  const Sizes sizes = {.law = SizeLaw::uniform,
                       .mean = 50,
                       .sd = 20,
                       .by = SharesBy::number,
                       .kinds = 64,
                       .diameters = {},
                       .shares = {},
                       .shape = RoundShape::disc};
  std::size_t last = 0;
  double all = 0;
  for (const SizeClass& one : size_classes(sizes)) {
    EXPECT_GT(shape_of(one).size(), last);
    last = shape_of(one).size();
    all += one.share;
  }
  EXPECT_NEAR(all, 1, 1e-4);
}

constexpr const char* kSpecies =
    "species: {small: {sizes: {law: list, diameters: [2.8, 4.6], shares: [2, 1]}}, "
    "large: {shape: {hexagon: 3}}}\n";

Scene scene_with_rest(std::string_view rest) {
  return parse(testing::scene_with(fmt::format("{}{}", kSpecies, rest)), "scene.yaml");
}

TEST(Sizes, DivideCountsWithoutALoss) {
  const Scene scene = scene_with_rest(
      "sources: {}\nstages: [{name: a, fill: {region: [0, 0, 100, 50], counts: {small: 10, large: "
      "2}}}]");
  ASSERT_EQ(scene.species.size(), 3U);
  EXPECT_EQ(scene.species[0].name, "small-1");
  EXPECT_EQ(scene.species[1].name, "small-2");
  EXPECT_EQ(scene.stages[0].fill->counts, (std::vector<std::size_t>{7, 3, 2}));
  EXPECT_EQ(parse(to_yaml(scene), "scene.yaml"), scene);
}

TEST(Sizes, DivideLargeCountsWithoutALossToo) {
  const Scene scene =
      parse(testing::scene_with("box: {width: 20000, height: 20000}\nsources: {}\noutlets: {}\n"
                                "species: {small: {sizes: {law: lognormal, mean: 5, sd: 2}}}\n"
                                "stages: [{name: a, fill: {region: [0, 0, 19000, 19000], counts: "
                                "{small: 12345679}}}]"),
            "scene.yaml");
  const auto& counts = scene.stages[0].fill->counts;
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), 12345679U);
}

TEST(Sizes, DivideWeightsOfMixesPicturesAndSources) {
  const Scene scene = scene_with_rest(
      "sources: {tap: {at: [50, 40], rate: 1, count: 9}}\n"
      "stages:\n"
      "  - {name: a, sources: [tap], fill: {region: [0, 0, 100, 50], mix: {small: 1, large: 2}}}\n"
      "  - {name: b, fill: {region: [0, 0, 100, 50], picture: {rows: [AB], pixels: {A: small, B: "
      "large}}}}");
  const std::vector<std::uint32_t> alike = {667, 333, 1000};
  EXPECT_EQ(scene.sources[0].weights, alike);
  EXPECT_EQ(scene.stages[0].fill->mix, (std::vector<std::uint32_t>{667, 333, 2000}));
  const auto& weights = scene.stages[1].fill->picture->weights;
  EXPECT_EQ(weights.at('A'), (std::vector<std::uint32_t>{667, 333, 0}));
  EXPECT_EQ(weights.at('B'), (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(parse(to_yaml(scene), "scene.yaml"), scene);
}

}  // namespace
}  // namespace clca::scene::sizes_test
