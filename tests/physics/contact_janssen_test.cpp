// Weight in a silo at rest by contact dynamics (Janssen 1895): what does not rest on the floor
// hangs at the sides by friction, and the higher the silo, the more. Silo 40 d wide, friction 0.4.
// Seeds 101 to 104 of the scene: the floor carries 1.002 +- 0.051 of the weight at 21 d, 0.823 +-
// 0.027 at 83 d.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "physics/seeds.hpp"

namespace clca::contact_janssen_test {
namespace {

constexpr int kSeeds = 3;

/// Share of the floor, mean over the seeds, of so many grains of each species.
double share_of_floor(int count, int height) {
  const std::vector<scene::Override> silo = {
      fmt::format("box.height={}", height),
      fmt::format(
          "stages.filling.fill={{region: [0, 0, 328, {}], counts: {{small: {}, large: {}}}}}",
          height, count, count)};
  std::vector<double> shares;
  testing::for_seeds(kSeeds, "janssen", silo, [&](const auto& summary, const auto& folder) {
    // On the walls, in weights of a grain of mean mass: floor, ceiling, left, right.
    const std::vector<double> weights = testing::csv_column(folder / "walls-rest.csv", "force_y");
    ASSERT_EQ(weights.size(), 4U);
    EXPECT_LT(weights[0], 0);
    const double carried = -(weights[0] + weights[2] + weights[3]);
    testing::expect_within("carried", carried / (2 * count), 0.98, 1.02);
    shares.push_back(testing::measure_of(summary, "rest", "load_floor"));
  });
  return testing::sample(shares).mean;
}

// Bounds: four standard errors of the mean of four seeds to either side; 0.033 of the difference.
TEST(ContactJanssen, FloorAndSidesCarryTheWeightAndTheFloorLessOfIt) {
  const double low = share_of_floor(395, 300);
  const double high = share_of_floor(1580, 1200);
  testing::expect_within("low", low, 0.90, 1.10);
  testing::expect_within("high", high, 0.77, 0.88);
  EXPECT_GT(low - high, 0.05);
}

}  // namespace
}  // namespace clca::contact_janssen_test
