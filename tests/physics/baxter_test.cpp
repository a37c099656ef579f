// Grains with an axis over an orifice: order of the axes, and what it does to the flow.

#include "physics/seeds.hpp"

namespace clca::baxter_test {
namespace {

struct Flow {
  std::vector<double> order;
  std::vector<double> outflow;
};

/// `outlet` over 10 columns, seeds 1 to 3.
Flow flow(double like_axes) {
  Flow flow;
  testing::for_seeds(
      3, "outlet",
      {"model=baxter", "let.d=1.05", "let.W=8.248", "baxter.power=1",
       fmt::format("baxter.like_axes={}", like_axes), "species.small.shape.hexagon=0",
       "species.large.shape.hexagon=0"},
      [&](const auto& summary, const auto& /*folder*/) {
        flow.order.push_back(testing::measure_of(summary, "flow", "axis_order"));
        flow.outflow.push_back(testing::measure_of(summary, "flow", "outflow_sites_per_step"));
      });
  return flow;
}

// No number of Baxter & Behringer is known to us. Those here are of a prototype of the same rule,
// written before it in another language, 3 seeds: order 0.87, outflow 5.47 ± 0.02. The seeds here
// give 0.848 to 0.854 and 5.34 to 5.46. Four standard deviations of the seeds or the difference
// between the two programs, whichever is more, fit the windows.
TEST(Baxter, AnEnergyOfAxesBringsOrderAndASteadyFlow) {
  const Flow with = flow(0.01);
  for (std::size_t seed = 0; seed < 3; ++seed) {
    testing::expect_within("order", with.order[seed], 0.82, 0.92);
    testing::expect_within("outflow", with.outflow[seed], 5.2, 5.7);
  }
}

// Likewise: order 0.32, two of three seeds in pulses of 2.6. Here 0.323 to 0.336 (a third at
// random; 15,000 pairs have a standard deviation of 0.004), and 3.4, 2.2, 3.7.
TEST(Baxter, WithoutItThereIsNoOrderAndTheFlowPulsates) {
  const Flow without = flow(1);
  for (std::size_t seed = 0; seed < 3; ++seed) {
    testing::expect_within("order", without.order[seed], 0.31, 0.36);
    testing::expect_within("outflow", without.outflow[seed], 1, 4.7);
  }
}

}  // namespace
}  // namespace clca::baxter_test
