// A hopper whose walls slope at 48 degrees, above the lattice's own 30, empties through its outlet.

#include "physics/seeds.hpp"

namespace clca::hopper_test {
namespace {

// 0.98 of the particles have to leave in the scene as it is; all of them do when it goes on to the
// end. The outflow is this program's own: 16 seeds gave 10.98 sites per step with a standard error
// of 0.09, so that 10 % is far more than chance does.
TEST(Hopper, NothingStaysOnTheSlantedWalls) {
  std::vector<double> outflows;
  testing::for_seeds(8, "hopper", {}, [&](const auto& summary, const auto&) {
    EXPECT_EQ(summary.stages.back().end_reason, "discharged");
    EXPECT_GE(testing::measure_of(summary, "discharge", "discharged_share"), 0.98);
    outflows.push_back(testing::measure_of(summary, "discharge", "outflow_sites_per_step"));
  });
  testing::expect_within("outflow", testing::sample(outflows).mean, 0.9 * 11, 1.1 * 11);
  testing::for_seeds(4, "hopper", {"stages.discharge.until=settled"},
                     [](const auto& summary, const auto&) {
                       EXPECT_EQ(testing::measure_of(summary, "discharge", "discharged_share"), 1);
                     });
}

}  // namespace
}  // namespace clca::hopper_test
