#include "clca/export/export.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "clca/export/frame.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/file.hpp"
#include "support/runs.hpp"
#include "support/states.hpp"

namespace clca::exports::export_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Frame = store::Trajectory::Frame;

scene::Scene two_species() {
  return scene::parse(R"(clca: 1
seed: 1
box: {width: 10, height: 10}
species:
  dot: {shape: {sites: [[0, 0]]}}
  rod: {shape: {rod: {radius: 0, length: 2}}, orientations: [60, 0, 180]}
stages:
  - name: only
    fill: {region: [0, 0, 10, 10], counts: {dot: 1, rod: 1}}
)",
                      "two.yaml");
}

/// A dot that has come up by one, a rod turned by 60 degrees at rest, and one that has left.
grains::State three_particles() {
  grains::State state = testing::empty_state(10, 10);
  state.kinds = {{lattice::Shape::hexagon(0), 0},
                 {lattice::Shape::rod(0, 2).rotated(1), 1},
                 {lattice::Shape::rod(0, 2), 1}};
  state.particles = {testing::particle_at(2, 3), testing::particle_at(4, 5, 1),
                     testing::particle_at(8, 8)};
  state.origins = {{2, 1}, {4, 5}, {8, 8}};
  state.particles[0].previous = 0;
  state.particles[2].present = false;
  state.step = 7;
  return state;
}

std::string text_of(const fs::path& file) {
  const auto bytes = testing::bytes_of(file);
  return {bytes.begin(), bytes.end()};
}

TEST(Bodies, ArePresentParticlesWithTheirLastMoveAndTheWayFromTheirOrigin) {
  const std::vector<Body> all = bodies(three_particles());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].id, 0U);
  EXPECT_NEAR((all[0].centre - Eigen::Vector2d(2 * lattice::kColumnPitch, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((all[0].velocity - Eigen::Vector2d(0, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR((all[0].displacement - Eigen::Vector2d(0, 2)).norm(), 0, 1e-12);
  EXPECT_EQ(all[1].velocity.norm(), 0);
  EXPECT_EQ(all[1].force, 0);
}

TEST(Bodies, OfTheContactModelHaveTheirVelocityAndTheSumOfTheirNormalForces) {
  const store::ContactFrame contact = {
      .velocities = {{0.25, -0.5}, {0, 0}, {1, 1}},
      .spins = {0.5, 0, 1},
      .forces = {{.upper = 1, .other = 0, .along_normal = 1.5, .along_shear = 9},
                 {.upper = 0, .other = contact::kFloor, .along_normal = 2.25}}};
  scene::Conversion units;
  units.spacing = 2;
  units.time_step = 0.5;
  const std::vector<Body> all = bodies(three_particles(), contact, units);
  EXPECT_EQ(all[0].velocity, Eigen::Vector2d(1, -2));
  const double radius = std::sqrt(std::numbers::sqrt3 / (2 * std::numbers::pi));  // of one site
  EXPECT_NEAR(all[0].angular_velocity, 0.5 / radius / 0.5, 1e-12);
  EXPECT_EQ(all[1].angular_velocity, 0);
  EXPECT_EQ(all[0].force, 3.75F);
  EXPECT_EQ(all[1].velocity.norm(), 0);
  EXPECT_EQ(all[1].force, 1.5F);
}

TEST(Bodies, StayInAPeriodicBoxAndCountHowOftenTheyLeftIt) {
  grains::State state = {.lattice = lattice::Lattice(10, 10, true)};
  state.kinds = {{lattice::Shape::hexagon(0), 0}};
  state.particles = {testing::particle_at(-1, 3), testing::particle_at(0, 3),
                     testing::particle_at(23, 3)};
  state.origins = {{9, 3}, {0, 3}, {3, 3}};
  const std::vector<Body> all = bodies(state);
  EXPECT_EQ(all[0].image, -1);
  EXPECT_NEAR(all[0].centre.x(), 9 * lattice::kColumnPitch, 1e-12);
  EXPECT_NEAR(all[0].displacement.x(), -10 * lattice::kColumnPitch, 1e-12);
  EXPECT_EQ(all[1].image, 0);
  EXPECT_EQ(all[2].image, 2);
  EXPECT_NEAR(all[2].centre.x(), 3 * lattice::kColumnPitch, 1e-12);
}

TEST(KindLooks, NameTheOrientationWhereASpeciesHasSeveral) {
  const auto looks = kind_appearances(two_species(), three_particles().kinds);
  ASSERT_EQ(looks.size(), 3U);
  EXPECT_EQ(looks[0].name, "dot");
  EXPECT_EQ(looks[1].name, "rod@60");
  EXPECT_EQ(looks[2].name, "rod@0");
  EXPECT_EQ(looks[0].outline.size(), 6U);
}

TEST(Chosen, KeepsTheBeatInEachStage) {
  const std::vector<Frame> frames = {{0, 0, 1}, {4, 0, 1},  {8, 0, 1},
                                     {8, 1, 1}, {12, 1, 1}, {16, 1, 1}};
  EXPECT_THAT(selected_frames(frames, {}), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(selected_frames(frames, {.every = 8}), ElementsAre(0, 2, 3, 5));
  EXPECT_THAT(selected_frames(frames, {.from = 5, .until = 12}), ElementsAre(2, 3, 4));
  EXPECT_THAT([&] { selected_frames(frames, {.from = 17}); },
              ::testing::ThrowsMessage<ExportError>(HasSubstr("from step 0 to 16")));
  EXPECT_THAT([&] { selected_frames({}, {}); },
              ::testing::ThrowsMessage<ExportError>(HasSubstr("no frames yet")));
}

TEST(Xyz, SaysEachParticleInALine) {
  const testing::ScratchFolder folder;
  const fs::path file = folder.path() / "a.xyz";
  const grains::State state = three_particles();
  const auto out = writer(Format::xyz, store::named_file(file), two_species(), state.kinds);
  out->add(state, {});
  EXPECT_FALSE(fs::exists(file));
  out->finish();
  EXPECT_EQ(text_of(file),
            "2\n"
            "Lattice=\"8.660254 0 0 0 10.500000 0 0 0 1\" Origin=\"-0.433013 -0.500000 -0.5\" "
            "Properties=species:S:1:pos:R:3:id:I:1:velo:R:3:displacement:R:3:force:R:1 "
            "Time=7 Step=7 pbc=\"F F F\"\n"
            "dot 1.732051 3.000000 0 0 0 1.000000 0 0 2.000000 0 0\n"
            "rod 3.897114 5.250000 0 1 0 0 0 0 0 0 0\n");
}

TEST(Vtp, ASecondFrameOfAStepHasAFileAndATimeOfItsOwn) {
  const testing::ScratchFolder folder;
  const fs::path file = folder.path() / "a<b&c.pvd";
  const grains::State state = three_particles();
  const auto out = writer(Format::vtp, store::named_file(file), two_species(), state.kinds);
  out->add(state, {});
  out->add(state, {});
  out->finish();
  EXPECT_TRUE(fs::exists(folder.path() / "a<b&c-000007.vtp"));
  EXPECT_TRUE(fs::exists(folder.path() / "a<b&c-000007-2.vtp"));
  EXPECT_THAT(text_of(file), HasSubstr("timestep=\"7.5\" part=\"0\" name=\"particles\" "
                                       "file=\"a&lt;b&amp;c-000007-2.vtp\""));
}

TEST(Writers, GiveTheTimeThatStepsOfTheContactModelTake) {
  const testing::ScratchFolder folder;
  const grains::State state = three_particles();
  scene::Scene scene = two_species();
  scene.model = scene::Model::contact;
  scene.contact.fall_height = 80;
  scene.units = {.spacing = 0.001, .gravity = 9.81};
  const double step = scene::conversion(scene)->time_step;
  const auto written = [&](Format format, const char* name) {
    const auto out = writer(format, store::named_file(folder.path() / name), scene, state.kinds);
    out->add(state, {});
    out->add(state, {});
    out->finish();
    return text_of(folder.path() / name);
  };
  EXPECT_THAT(written(Format::xyz, "a.xyz"), HasSubstr(fmt::format("Time={} Step=7", 7 * step)));
  EXPECT_THAT(written(Format::vtp, "a.pvd"),
              AllOf(HasSubstr(fmt::format("timestep=\"{}\" part=\"0\"", 7 * step)),
                    HasSubstr(fmt::format("timestep=\"{}\" part=\"0\"", 7.5 * step))));
}

TEST(Writers, LeaveNothingUnlessTheyFinish) {
  const testing::ScratchFolder folder;
  for (const Format format : {Format::gsd, Format::xyz}) {
    const grains::State state = three_particles();
    writer(format, store::named_file(folder.path() / "a"), two_species(), state.kinds)
        ->add(state, {});
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Gsd, BeginsWithTheNumberAndTheVersionsOfTheLayout) {
  const testing::ScratchFolder folder;
  const grains::State state = three_particles();
  const auto out =
      writer(Format::gsd, store::named_file(folder.path() / "a.gsd"), two_species(), state.kinds);
  out->add(state, {});
  out->finish();
  const std::string text = text_of(folder.path() / "a.gsd");
  EXPECT_THAT(text, StartsWith("\xDF\x65\xDF\x65\xDF\x65\xDF\x65"));
  EXPECT_EQ(text.substr(40, 8), std::string("\x04\x00\x01\x00\x00\x00\x02\x00", 8));
  EXPECT_EQ(text.substr(48, 5), "clca" + std::string(1, '\0'));
  EXPECT_EQ(text.substr(112, 6), "hoomd" + std::string(1, '\0'));
}

}  // namespace
}  // namespace clca::exports::export_test
