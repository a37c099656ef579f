// Heaps from a point source under gravity alone: the angle of repose by shape. Numbers: an
// independent prototype's, with the tolerances it states. Heaps of a mix are steeper when they are
// larger (400 grains 54 degrees, 1,500 grains 56); the prototype's had a few hundred.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ostream>

#include "support/runs.hpp"

namespace clca::heap_test {
namespace {

struct HeapReference {
  const char* name;
  int first_radius, second_radius;
  int count;
  double low, high;  // degrees, for the mean
};

/// For the names of the tests.
// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const HeapReference& heap, std::ostream* stream) {
  *stream << heap.name;
}

class Heap : public ::testing::TestWithParam<HeapReference> {};

TEST_P(Heap, HasTheAngleOfReposeOfItsShapes) {
  const HeapReference reference = GetParam();
  std::vector<double> angles;
  for (int seed = 1; seed <= 16; ++seed) {
    const testing::ScratchFolder folder;
    const auto summary = run::run(
        testing::bare_scene("heap",
                            {fmt::format("seed={}", seed), "rules.inertia=0",
                             fmt::format("species.small.shape.hexagon={}", reference.first_radius),
                             fmt::format("species.large.shape.hexagon={}", reference.second_radius),
                             fmt::format("sources.spout.count={}", reference.count)}),
        {.folder = folder.path()});
    angles.push_back(testing::measure_of(summary, summary.stages.back().name, "repose_angle_deg"));
  }
  const double mean = testing::sample(angles).mean;
  RecordProperty("repose_angle_deg", fmt::format("{:.4g}", mean));
  EXPECT_GE(mean, reference.low);
  EXPECT_LE(mean, reference.high);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Heap,
                         ::testing::Values(HeapReference{"SingleSites", 0, 0, 8000, 29.0, 30.01},
                                           HeapReference{"R1", 1, 1, 1000, 46.5, 48.5},
                                           HeapReference{"R2", 2, 2, 400, 51.5 - 1.7, 51.5 + 1.7},
                                           HeapReference{"MixOneToOne", 1, 2, 400, 52.3 - 4.2,
                                                         52.3 + 4.2}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace clca::heap_test
