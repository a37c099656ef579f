// Species whose sizes follow a law.

#include "scene/sizes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::sizes_test {
namespace {

lattice::Shape shape_of(const SizeClass& one, RoundShape shape) {
  return shape == RoundShape::disc ? lattice::Shape::disc(one.radius)
                                   : lattice::Shape::hexagon(static_cast<int>(one.radius));
}

struct Moments {
  double mean = 0;
  double sd = 0;
};

/// Of the diameters, by number or by area as the law.
Moments moments_of(const SizeDistribution& sizes) {
  double all = 0;
  double sum = 0;
  double squares = 0;
  for (const SizeClass& one : size_classes(sizes)) {
    const lattice::Shape shape = shape_of(one, sizes.shape);
    const double weight =
        one.share * (sizes.shares_by == SharesBy::area ? static_cast<double>(shape.size()) : 1);
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
      const SizeDistribution sizes = {.law = law,
                                      .mean = 20,
                                      .sd = 5,
                                      .shares_by = by,
                                      .class_count = 12,
                                      .diameters = {},
                                      .shares = {},
                                      .shape = RoundShape::disc};
      const Moments found = moments_of(sizes);
      EXPECT_NEAR(found.mean, 20, 0.2);
      EXPECT_NEAR(found.sd, 5, 0.3);
    }
  }
}

// A class below 1.05, a single site, would raise it.
TEST(Sizes, HaveTheMeanOfTheirLawByNumberAndByArea) {
  struct Law {
    SizeLaw law;
    double mean;
    double sd;
  };
  for (const auto& [law, mean, sd] : {Law{SizeLaw::lognormal, 6, 0.6},
                                      {SizeLaw::lognormal, 6, 1.8},
                                      {SizeLaw::lognormal, 8, 6},
                                      {SizeLaw::lognormal, 4, 2},
                                      {SizeLaw::lognormal, 20, 12},
                                      {SizeLaw::uniform, 7.3, 0.2},
                                      {SizeLaw::uniform, 20, 10},
                                      {SizeLaw::uniform, 3, 0.3}}) {
    for (const SharesBy by : {SharesBy::number, SharesBy::area}) {
      for (const RoundShape shape : {RoundShape::hexagon, RoundShape::disc}) {
        for (const std::uint64_t kinds : {1U, 2U, 8U, 64U}) {
          const SizeDistribution sizes = {.law = law,
                                          .mean = mean,
                                          .sd = sd,
                                          .shares_by = by,
                                          .class_count = kinds,
                                          .diameters = {},
                                          .shares = {},
                                          .shape = shape};
          const double found = moments_of(sizes).mean;
          const bool has_single_sites = law == SizeLaw::lognormal && kinds == 64 && mean < 10;
          EXPECT_NEAR(found, mean, mean * (has_single_sites ? 0.005 : 1e-6))
              << mean << " " << sd << " " << static_cast<int>(by) << static_cast<int>(shape) << " "
              << kinds;
        }
      }
    }
  }
}

TEST(Sizes, OfAClassBetweenTwoHexagonsAreDividedByAreaWhereTheLawIs) {
  const Scene scene =
      parse(testing::scene_with(
                "box: {width: 3000, height: 3000}\nsources: {}\noutlets: {}\nspecies: {g: "
                "{sizes: {law: uniform, mean: 7.3, sd: 0.2, by: area, kinds: 1}}}\n"
                "stages: [{name: a, fill: {region: [0, 0, 2900, 2900], counts: {g: "
                "10000}}}]"),
            "scene.yaml");
  // Diameters 6.3874 (37 sites) and 8.2014 (61): 0.4969 / 37 to 0.5031 / 61.
  EXPECT_EQ(scene.stages[0].fill->species_counts, (std::vector<std::size_t>{6195, 3805}));
}

TEST(Sizes, OfWhichACountLeavesNoneAreLeftOut) {
  const Scene scene = parse(
      testing::scene_with("box: {width: 900, height: 900}\nsources: {}\noutlets: {}\nspecies: {g: "
                          "{sizes: {law: lognormal, mean: 5, sd: 1.5, by: area}}}\n"
                          "stages: [{name: a, fill: {region: [0, 0, 900, 900], counts: {g: "
                          "500}}}]"),
      "scene.yaml");
  double sites = 0;
  double sum = 0;
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const auto count = static_cast<double>(scene.stages[0].fill->species_counts[i]);
    EXPECT_GT(count, 0);
    const auto size = static_cast<double>(scene.species[i].shape.size());
    sites += count * size;
    sum += count * size * scene.species[i].shape.diameter();
  }
  EXPECT_NEAR(sum / sites, 5, 0.05);
}

TEST(Sizes, OfRareLargeParticlesHaveTheirAreaInAMix) {
  const Scene scene = parse(
      testing::scene_with("sources: {}\noutlets: {}\nspecies: {g: {sizes: {law: list, diameters: "
                          "[1.05, 20.87], shares: [1, 1], by: area}}}\n"
                          "stages: [{name: a, fill: {region: [0, 0, 100, 50], mix: {g: 1}}}]"),
      "scene.yaml");
  const std::vector<std::uint32_t>& mix = scene.stages[0].fill->species_weights;
  const std::size_t large = scene.species[1].shape.size();
  ASSERT_EQ(large, 397U);
  EXPECT_NEAR(static_cast<double>(mix[0]) / mix[1], static_cast<double>(large), 0.1);
}

TEST(Sizes, OfAListAreThoseNearestToIt) {
  const SizeDistribution sizes = {.law = SizeLaw::list,
                                  .mean = {},
                                  .sd = {},
                                  .shares_by = SharesBy::area,
                                  .class_count = 8,
                                  .diameters = {2.8, 4.6, 4.5},
                                  .shares = {7, 10, 9},
                                  .shape = RoundShape::hexagon};
  const std::vector<SizeClass> classes = size_classes(sizes);
  ASSERT_EQ(classes.size(), 2U);  // 7 and 19 sites
  EXPECT_EQ(classes[0].radius, 1);
  EXPECT_EQ(classes[1].radius, 2);
  EXPECT_NEAR(classes[0].share, 0.5, 1e-9);
}

TEST(Sizes, DiscsOfDifferentSizesDiffer) {
  const SizeDistribution sizes = {.law = SizeLaw::uniform,
                                  .mean = 50,
                                  .sd = 20,
                                  .shares_by = SharesBy::number,
                                  .class_count = 64,
                                  .diameters = {},
                                  .shares = {},
                                  .shape = RoundShape::disc};
  std::size_t last = 0;
  double all = 0;
  for (const SizeClass& one : size_classes(sizes)) {
    EXPECT_GT(shape_of(one, sizes.shape).size(), last);
    last = shape_of(one, sizes.shape).size();
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
  EXPECT_EQ(scene.stages[0].fill->species_counts, (std::vector<std::size_t>{7, 3, 2}));
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Sizes, DivideLargeCountsWithoutALossToo) {
  const Scene scene =
      parse(testing::scene_with("box: {width: 20000, height: 20000}\nsources: {}\noutlets: {}\n"
                                "species: {small: {sizes: {law: lognormal, mean: 5, sd: 2}}}\n"
                                "stages: [{name: a, fill: {region: [0, 0, 19000, 19000], counts: "
                                "{small: 12345679}}}]"),
            "scene.yaml");
  const auto& counts = scene.stages[0].fill->species_counts;
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), 12345679U);
}

TEST(Sizes, DivideWeightsOfMixesPicturesAndSources) {
  const Scene scene = scene_with_rest(
      "sources: {tap: {at: [50, 40], rate: 1, count: 9}}\n"
      "stages:\n"
      "  - {name: a, sources: [tap], fill: {region: [0, 0, 100, 50], mix: {small: 1, large: 2}}}\n"
      "  - {name: b, fill: {region: [0, 0, 100, 50], picture: {rows: [AB], pixels: {A: small, B: "
      "large}}}}");
  const std::vector<std::uint32_t> alike = {666667, 333333, 1000000};
  EXPECT_EQ(scene.sources[0].species_weights, alike);
  EXPECT_EQ(scene.stages[0].fill->species_weights,
            (std::vector<std::uint32_t>{333333, 166667, 1000000}));
  const auto& weights = scene.stages[1].fill->picture->weights_by_letter;
  EXPECT_EQ(weights.at('A'), (std::vector<std::uint32_t>{666667, 333333, 0}));
  EXPECT_EQ(weights.at('B'), (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

}  // namespace
}  // namespace clca::scene::sizes_test
