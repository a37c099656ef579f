// What holds at every moment while plates and pistons push, whatever the shapes and however many
// plates: exact, so without windows. Two seeds each.

#include <algorithm>
#include <ostream>

#include "clca/automaton/automaton.hpp"
#include "clca/measure/force.hpp"
#include "clca/model/initial_state.hpp"
#include "physics/seeds.hpp"
#include "support/overlaps.hpp"
#include "support/stages.hpp"

namespace clca::pushing_test {
namespace {

struct PushingCase {
  std::string name;
  std::string scene;
  std::vector<scene::Override> overrides;
};

/// For the names of the tests.
// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const PushingCase& pushing, std::ostream* stream) {
  *stream << pushing.name;
}

/// The bed of a scene in two stages, and its second, in which something pushes.
class Pushing {
 public:
  explicit Pushing(const scene::Scene& scene)
      : automaton_(testing::stage_begun(scene, 0, model::initial_state(scene)),
                   scene.automaton_rules) {
    while (!automaton_.step().settled) {
    }
    count_ = grains::present_count(automaton_.state());
    automaton_ = automaton::Automaton(testing::stage_begun(scene, 1, automaton_.state()),
                                      scene.automaton_rules);
  }

  /// Pushes until nothing changes, looks every 20 steps and at the end, and returns the last step.
  grains::StepReport push() {
    grains::StepReport report;
    for (int step = 1; step < kMost && !report.settled; ++step) {
      report = automaton_.step();
      if (step % 20 == 0 || report.settled) {
        look();
      }
    }
    EXPECT_TRUE(report.settled);
    return report;
  }

  std::vector<measure::OverlapContact> contacts() const {
    return measure::overlap_contacts(automaton_.state(), automaton_.occupancy());
  }
  const grains::State& state() const { return automaton_.state(); }

 private:
  static constexpr int kMost = 5000;

  void look() const {
    EXPECT_EQ(testing::complaint(state()), "");
    EXPECT_EQ(grains::present_count(state()), count_);
    for (const measure::OverlapContact& contact : contacts()) {
      EXPECT_EQ(contact.depth, 1);
    }
  }

  automaton::Automaton automaton_;
  std::size_t count_ = 0;
};

std::vector<scene::Override> seeded(const std::vector<scene::Override>& overrides, int seed) {
  auto all = overrides;
  all.push_back(fmt::format("seed={}", seed));
  return all;
}

class PushingUntilItStalls : public ::testing::TestWithParam<PushingCase> {};

TEST_P(PushingUntilItStalls, LosesNobodyAndNeverOverlapsByMoreThanOneMove) {
  const PushingCase& pushing = GetParam();
  for (int seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    Pushing bed(testing::bare_scene(pushing.scene, seeded(pushing.overrides, seed)));
    EXPECT_EQ(bed.push().moved_count, 0U);
    EXPECT_FALSE(bed.contacts().empty());
    for (const grains::Wall& wall : bed.state().walls) {
      EXPECT_TRUE(wall.travel.stalled_since);
    }
  }
}

std::vector<PushingCase> pushing_cases() {
  const std::vector<scene::Override> rods = {
      "species.small={shape: {rod: {radius: 0, length: 4}}, orientations: any}",
      "species.large={shape: {rod: {radius: 1, length: 4}}, orientations: any}"};
  const std::vector<scene::Override> triangles = {
      "species.small={shape: {polygon: [[0, 0], [2, 0], [0, 2]]}, orientations: any}",
      "species.large={shape: {polygon: [[0, 0], [3, 0], [0, 3]]}, orientations: any}"};
  const std::vector<scene::Override> two = {
      "walls.second={box: [30, 110, 37, 240], passive: overlap, "
      "motion: {direction: down, period: 2, distance: 90}}",
      "stages.penetration.insert=[plate, second]", "stages.penetration.move=[plate, second]"};
  return {{"PlateOnHexagons", "plate-penetration", {}},
          {"PlateOnRods", "plate-penetration", rods},
          {"PlateOnTriangles", "plate-penetration", triangles},
          {"TwoPlates", "plate-penetration", two},
          {"PistonOnHexagons", "piston", {}},
          {"PistonOnRods", "piston", rods},
          {"PistonOnTriangles", "piston", triangles}};
}

INSTANTIATE_TEST_SUITE_P(Shapes, PushingUntilItStalls, ::testing::ValuesIn(pushing_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(PlateThatTurnsBack, LeavesOverlapBehindAndTouchesNobody) {
  for (int seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    Pushing bed(testing::bare_scene(
        "plate-penetration", seeded({"walls.plate={box: [66.5, 110, 73.5, 240], passive: overlap, "
                                     "motion: {direction: down, path: [[200, 50], [400, 0]]}}"},
                                    seed)));
    bed.push();
    EXPECT_EQ(bed.state().walls[0].travel.offset, 0);
    const auto contacts = bed.contacts();
    EXPECT_FALSE(contacts.empty());
    EXPECT_TRUE(std::all_of(contacts.begin(), contacts.end(), [](const auto& contact) {
      return grains::is_particle(contact.second);
    }));
  }
}

}  // namespace
}  // namespace clca::pushing_test
