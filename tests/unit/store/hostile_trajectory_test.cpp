// Parts that are whole, and say what no run has said.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "clca/model/initial_state.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "store/trajectory_part.hpp"
#include "support/runs.hpp"
#include "support/states.hpp"
#include "support/trajectories.hpp"

namespace clca::store::hostile_trajectory_test {
namespace {

using ::testing::EndsWith;

constexpr double kMuch = 1e8;
constexpr OptionalDatasets kLayout = {.wall_count = 1};

struct Hostile {
  const char* name;
  std::function<void(TrajectoryPart&)> change;
  const char* reason;  ///< the end of the message
};

class HostileTrajectory : public ::testing::TestWithParam<Hostile> {};

std::filesystem::path only_part(const std::filesystem::path& run) {
  return run / "trajectory" / "part-000000.h5";
}

/// The plate scene from the frame on in which the plate begins to move.
void write_plate(const std::filesystem::path& run) {
  const scene::Scene scene = testing::plate_scene();
  TrajectoryWriter writer(OutputFolder(run), scene, model::initial_state(scene), {});
  testing::play(scene, 10, [&](const grains::State& state, std::size_t stage, bool begins) {
    if (stage == 1) {
      writer.add_frame(state, stage, begins);
    }
  });
  writer.flush();
}

void rewrite(const std::filesystem::path& path, const std::function<void(TrajectoryPart&)>& change,
             const OptionalDatasets& layout = kLayout) {
  TrajectoryPart part;
  SceneTables tables;
  std::vector<Hdf5Dataset> datasets = tables.datasets();
  const std::vector<TrajectoryDataset> columns = part.datasets(layout);
  datasets.insert(datasets.end(), columns.begin(), columns.end());
  read_hdf5(path, kTrajectoryKind, datasets, kMuch);
  change(part);
  write_whole_file(
      path, with_header(kTrajectoryKind, hdf5::file_bytes(path, [&](const hdf5::Handle& file) {
                          for (const Hdf5Dataset& dataset : tables.datasets()) {
                            hdf5::add_dataset(file, dataset);
                          }
                          for (const TrajectoryDataset& column : columns) {
                            if (!column.may_be_missing || !part.rows.spin.empty()) {
                              hdf5::add_dataset(file, column);
                            }
                          }
                        })));
}

std::string reason(const std::filesystem::path& run,
                   const scene::Scene& scene = testing::plate_scene()) {
  try {
    const Trajectory trajectory(run, scene, model::initial_state(scene), kMuch);
    for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
      trajectory.state(frame);
      trajectory.contact_frame(frame);
    }
  } catch (const StoreError& error) {
    return error.what();
  }
  return "";
}

/// Two grains, the first one on the floor and on the second one.
void write_contacts(const std::filesystem::path& run, const scene::Scene& scene) {
  grains::State state = model::initial_state(scene);
  state.particles = {testing::particle_at(5, 5), testing::particle_at(9, 5)};
  state.origins = {{5, 5}, {9, 5}};
  const contact::Force force = {
      .upper = 0, .other = 1, .point = {5, 5}, .normal = {0, 1}, .branch = {0, 2}};
  contact::Force on_floor = force;
  on_floor.other = contact::kFloor;
  TrajectoryWriter writer(OutputFolder(run), scene, state, {});
  writer.add_frame(state, 0, true,
                   {.velocities = {{0, 1}, {2, 3}}, .spins = {4, 5}, .forces = {force, on_floor}});
  writer.flush();
}

scene::Scene contact_scene() {
  return scene::parse(R"(clca: 1
model: contact
box: {width: 20, height: 20}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: only, fill: {region: [0, 0, 20, 20], counts: {grain: 2}}}]
output: {trajectory: {contacts: true}}
)",
                      "two.yaml");
}

TEST(HostileTrajectory, FilesOfEarlierVersionsAreReadWithoutSpins) {
  const testing::ScratchFolder folder;
  const scene::Scene scene = contact_scene();
  write_contacts(folder.path(), scene);
  const auto spins = [&] {
    const Trajectory trajectory(folder.path(), scene, model::initial_state(scene), kMuch);
    return trajectory.contact_frame(0).spins;
  };
  EXPECT_EQ(spins(), std::vector<double>({4, 5}));
  rewrite(only_part(folder.path()), [](TrajectoryPart& part) { part.rows.spin.clear(); },
          {.has_velocities = true, .has_contacts = true});
  EXPECT_THAT(spins(), ::testing::ElementsAre(::testing::IsNan(), ::testing::IsNan()));
}

TEST(HostileTrajectory, ContactsOfBodiesThatAreNotThereAreRefused) {
  const scene::Scene scene = contact_scene();
  const auto reason_of = [&](const std::function<void(TrajectoryPart&)>& change) {
    const testing::ScratchFolder folder;
    write_contacts(folder.path(), scene);
    rewrite(only_part(folder.path()), change, {.has_velocities = true, .has_contacts = true});
    return reason(folder.path(), scene);
  };
  constexpr const char* kNotThere = "frame of step 0: a contact of bodies that are not there";
  EXPECT_EQ(reason_of([](TrajectoryPart&) {}), "");
  EXPECT_THAT(reason_of([](auto& part) { part.rows.contact_upper[0] = 2; }), EndsWith(kNotThere));
  EXPECT_THAT(reason_of([](auto& part) { part.rows.contact_other[0] = 2; }), EndsWith(kNotThere));
  EXPECT_THAT(reason_of([](auto& part) { part.rows.contact_other[0] = -2; }), EndsWith(kNotThere));
  EXPECT_THAT(reason_of([](auto& part) { part.rows.contact_other[1] += 4; }), EndsWith(kNotThere));
  EXPECT_THAT(reason_of([](auto& part) { part.rows.spin.resize(1); }),
              EndsWith("particles/spin has 1 rows, not 2"));
  EXPECT_THAT(reason_of([](auto& part) { part.rows.contact_normal.resize(2); }),
              EndsWith("contacts/normal has 1 rows, not 2"));
  EXPECT_THAT(
      reason_of([](auto& part) { part.frames.row_ranges[RowKind::contacts].row_counts[0] = 1; }),
      EndsWith("contacts/upper has 2 rows, not 1"));
}

TEST(HostileTrajectory, ThePartThatIsChangedIsReadAsLongAsItIsNot) {
  const testing::ScratchFolder folder;
  write_plate(folder.path());
  rewrite(only_part(folder.path()), [](TrajectoryPart& part) {
    EXPECT_GT(part.frames.row_ranges[RowKind::pushes].row_counts.back(), 1U)
        << "there is something to change";
    EXPECT_EQ(part.frames.step.size(), 8U);
  });
  EXPECT_EQ(reason(folder.path()), "");
}

TEST_P(HostileTrajectory, IsRefused) {
  const testing::ScratchFolder folder;
  write_plate(folder.path());
  rewrite(only_part(folder.path()), GetParam().change);
  EXPECT_THAT(reason(folder.path()), EndsWith(GetParam().reason));
  EXPECT_THAT(reason(folder.path()),
              ::testing::StartsWith("cannot read " + only_part(folder.path()).string() + ": "));
}

constexpr auto kLeast = std::numeric_limits<std::int32_t>::min();
constexpr auto kMost = std::numeric_limits<std::int32_t>::max();

INSTANTIATE_TEST_SUITE_P(
    Parts, HostileTrajectory,
    ::testing::Values(
        Hostile{"no_frames", [](TrajectoryPart& part) { part = {}; }, "no frames"},
        Hostile{"lists_of_frames", [](TrajectoryPart& part) { part.frames.stage.pop_back(); },
                "frames/stage has 7 rows, not 8"},
        Hostile{"counts_of_pushes",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::pushes].row_counts.pop_back(); },
                "frames/pushes has 7 rows, not 8"},
        Hostile{"steps", [](TrajectoryPart& part) { std::swap(part.frames.step[0], part.frames.step[5]); },
                "frames are not in order"},
        Hostile{"stage", [](TrajectoryPart& part) { part.frames.stage.back() = 2; },
                "frame of step 130: a stage that the scene does not have"},
        Hostile{"entered", [](TrajectoryPart& part) { part.frames.entered_particles.back() = 4'000'000'000; },
                "frame of step 130: needs more memory than the limit"},
        Hostile{"fewer_entered", [](TrajectoryPart& part) { part.frames.entered_particles.back() = 79; },
                "frame of step 130: ids out of order or out of range"},
        Hostile{"more_particles",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::particles].row_counts.back() = 4'000'000'000; },
                "particles/id has 640 rows, not 4000000560"},
        Hostile{"fewer_rows", [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::particles].row_counts.back() = 70; },
                "particles/id has 640 rows, not 630"},
        Hostile{"more_origins",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::origins].row_counts.back() = 81; },
                "origins/id has 80 rows, not 161"},
        Hostile{"origins_without_rows",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::origins].row_counts.back() = 80; },
                "origins/id has 80 rows, not 160"},
        Hostile{"first_rows",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::particles].first_rows[3] = ~std::uint64_t{0}; },
                "rows of frames do not follow each other"},
        Hostile{"first_of_all",
                [](TrajectoryPart& part) {
                  for (std::uint64_t& first : part.frames.row_ranges[RowKind::pushes].first_rows) {
                    first += 1;
                  }
                },
                "rows of frames do not follow each other"},
        Hostile{"pushes_without_rows",
                [](TrajectoryPart& part) { part.frames.row_ranges[RowKind::pushes].row_counts.back() = 4'000'000'000; },
                "pushes/pushed has 97 rows, not 4000000069"},
        Hostile{"origin_column", [](TrajectoryPart& part) { part.origins.site[0] = kLeast; },
                "frame of step 60: an origin is too far away"},
        Hostile{"origin_id", [](TrajectoryPart& part) { part.origins.id.back() = 80; },
                "frame of step 60: ids out of order or out of range"},
        Hostile{"no_origins",
                [](TrajectoryPart& part) {
                  part.origins = {};
                  part.frames.row_ranges[RowKind::origins].first_rows.assign(8, 0);
                  part.frames.row_ranges[RowKind::origins].row_counts.assign(8, 0);
                },
                "frame of step 60: a particle without an origin"},
        Hostile{"odd_sites", [](TrajectoryPart& part) { part.rows.site.resize(part.rows.site.size() - 2); },
                "particles/site has 639 rows, not 640"},
        Hostile{"kind", [](TrajectoryPart& part) { part.rows.kind[81] = 2; },
                "frame of step 70: a particle is of no kind"},
        Hostile{"move", [](TrajectoryPart& part) { part.rows.last_move[81] = 7; }, "frame of step 70: the last move of a particle is out of range"},
        Hostile{"column_right", [](TrajectoryPart& part) { part.rows.site[0] = kMost; },
                "frame of step 60: a particle is too far away"},
        Hostile{"column_left", [](TrajectoryPart& part) { part.rows.site[0] = kLeast; },
                "frame of step 60: a particle is too far away"},
        Hostile{"row_above", [](TrajectoryPart& part) { part.rows.site[1] = kMost; },
                "frame of step 60: a particle is too far away"},
        Hostile{"row_at_the_rim", [](TrajectoryPart& part) { part.rows.site[1] = 0; },
                "frame of step 60: a particle leaves the box"},
        Hostile{"two_in_one_place",
                [](TrajectoryPart& part) {
                  part.rows.site[2] = part.rows.site[0];
                  part.rows.site[3] = part.rows.site[1];
                },
                "frame of step 60: two particles overlap, or a particle overlaps a wall"},
        Hostile{"ids_twice", [](TrajectoryPart& part) { part.rows.id[1] = 0; },
                "frame of step 60: ids out of order or out of range"},
        Hostile{"id", [](TrajectoryPart& part) { part.rows.id[79] = 80; },
                "frame of step 60: ids out of order or out of range"},
        Hostile{"wall_rows", [](TrajectoryPart& part) { part.rows.wall_present.pop_back(); },
                "walls/present has 7 rows, not 8"},
        Hostile{"wall_presence", [](TrajectoryPart& part) { part.rows.wall_present[0] = 2; },
                "frame of step 60: a wall neither present nor absent"},
        Hostile{"wall_too_far", [](TrajectoryPart& part) { part.rows.wall_offset[7] = 31; },
                "frame of step 130: a wall is where its motion never goes"},
        Hostile{"wall_back", [](TrajectoryPart& part) { part.rows.wall_offset[7] = kLeast; },
                "frame of step 130: a wall is where its motion never goes"},
        Hostile{"push_direction", [](TrajectoryPart& part) { part.rows.push_direction[0] = 6; },
                "frame of step 90: a push names a particle, wall or direction that does not exist"},
        Hostile{"pushed", [](TrajectoryPart& part) { part.rows.pushed.back() = 4'000'000'000; },
                "frame of step 130: a push names a particle, wall or direction that does not exist"},
        Hostile{"pusher_wall", [](TrajectoryPart& part) { part.rows.pusher.back() = kLeast; },
                "frame of step 130: a push names a particle, wall or direction that does not exist"},
        Hostile{"pusher_nobody", [](TrajectoryPart& part) { part.rows.pusher.back() = -1; },
                "frame of step 130: a push names a particle, wall or direction that does not exist"},
        Hostile{"pusher_particle", [](TrajectoryPart& part) { part.rows.pusher.back() = kMost; },
                "frame of step 130: a push names a particle, wall or direction that does not exist"},
        Hostile{"pushes_itself",
                [](TrajectoryPart& part) {
                  part.rows.pusher.back() = static_cast<std::int32_t>(part.rows.pushed.back());
                },
                "frame of step 130: two particles overlap, or a particle overlaps a wall"},
        Hostile{"source_of_push", [](TrajectoryPart& part) { part.rows.push_source.back() = 1; },
                "frame of step 130: a push names a particle, wall or direction that does not exist"},
        Hostile{"order_of_pushes",
                [](TrajectoryPart& part) {
                  const std::size_t last = part.rows.pushed.size() - 1;
                  std::swap(part.rows.pushed[last], part.rows.pushed[last - 1]);
                  std::swap(part.rows.pusher[last], part.rows.pusher[last - 1]);
                },
                "frame of step 130: pushes are out of order"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace clca::store::hostile_trajectory_test
