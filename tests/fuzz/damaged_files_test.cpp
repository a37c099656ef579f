// Parts of trajectories with damage, and checkpoints with damage under a right checksum: each is
// read or refused with one line, within the limit of memory. CLCA_DAMAGED_FILES says how many of
// each kind.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>

#include "clca/automaton/automaton.hpp"
#include "clca/model/initial_state.hpp"
#include "clca/run/run.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "damage.hpp"
#include "small_run.hpp"
#include "store/checksum_header.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"

namespace clca::damaged_files_test {
namespace {

namespace fs = std::filesystem;
using fuzz::Bytes;
using fuzz::Damage;

constexpr double kLimit = 1e8;
constexpr store::FileKind kCheckpointKind = {"checkpoint", 3};

unsigned files_of_a_kind() {
  const char* number = std::getenv("CLCA_DAMAGED_FILES");
  return number != nullptr ? static_cast<unsigned>(std::stoul(number)) : 100;
}

Bytes content_of(const Bytes& file) {
  return {file.begin() + store::kHeaderBytes, file.end()};
}

/// How many were read, and how many refused, in the order of their numbers.
struct Answers {
  unsigned read = 0;
  unsigned refused = 0;
};

/// Calls use(damage) for each number; what it throws has to be one line for a user.
template <class Use>
void use_damaged(const char* kind, Use use) {
  Answers answers;
  for (unsigned number = 0; number < files_of_a_kind(); ++number) {
    SCOPED_TRACE(number);
    Damage damage(number);
    try {
      use(damage);
      ++answers.read;
    } catch (const store::StoreError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      ++answers.refused;
    } catch (const scene::SceneError&) {
      ++answers.refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  std::printf("%s: %u read, %u refused\n", kind, answers.read, answers.refused);
  EXPECT_GT(answers.refused, files_of_a_kind() / 4);
}

/// Of this process.
void expect_memory_below(double bytes) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  if (!testing::kSanitized) {
    EXPECT_LT(static_cast<double>(usage.ru_maxrss) * 1024, bytes);
  }
}

class DamagedTrajectory : public ::testing::Test {
 protected:
  DamagedTrajectory() {
    store::TrajectoryWriter writer(store::OutputFolder(folder_.path()), fuzz::small_scene(), fixed_,
                                   {});
    std::size_t frames = 0;
    for (const fuzz::SmallFrame& frame : fuzz::small_run()) {
      writer.add_frame(frame.state, frame.stage, frame.stage_begins);
      if (++frames == 4) {
        writer.flush();
      }
    }
    writer.flush();
    written_ = writer.written();
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      parts_.at(part) = testing::bytes_of(path(part));
    }
  }

  fs::path path(std::size_t part) const {
    return folder_.path() / "trajectory" / ("part-00000" + std::to_string(part) + ".h5");
  }
  /// One part damaged, the other whole.
  void put(Damage& damage) const {
    const std::size_t part = damage.below(parts_.size());
    const Bytes& other = parts_.at(1 - part);
    write(part, damage.damaged(parts_.at(part), other));
    write(1 - part, other);
  }

  testing::ScratchFolder folder_;
  grains::State fixed_ = model::initial_state(fuzz::small_scene());
  store::TrajectoryWriter::Written written_;

 private:
  void write(std::size_t part, const Bytes& bytes) const {
    store::write_whole_file(path(part), bytes);
  }

  std::array<Bytes, 2> parts_;
};

TEST_F(DamagedTrajectory, IsReadOrRefused) {
  use_damaged("trajectories", [&](Damage& damage) {
    put(damage);
    const store::Trajectory trajectory(folder_.path(), fuzz::small_scene(), fixed_, kLimit);
    for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
      automaton::Automaton(trajectory.state(frame), fuzz::small_scene().automaton_rules).step();
    }
  });
  expect_memory_below(4 * kLimit);
}

TEST_F(DamagedTrajectory, IsGoneOnWithOrRefused) {
  use_damaged("trajectories of runs that go on", [&](Damage& damage) {
    put(damage);
    const store::TrajectoryWriter writer(store::OutputFolder(folder_.path()), fuzz::small_scene(),
                                         fixed_, written_);
  });
  expect_memory_below(4 * kLimit);
}

/// Numbers of some columns changed, or columns cut, prolonged or of other numbers.
void change_columns(store::Checkpoint& checkpoint, Damage& damage) {
  for (std::size_t changes = 1 + damage.below(3); changes > 0; --changes) {
    auto column = checkpoint.fields.begin();
    std::advance(column, static_cast<std::ptrdiff_t>(damage.below(checkpoint.fields.size())));
    auto other = checkpoint.fields.begin();
    std::advance(other, static_cast<std::ptrdiff_t>(damage.below(checkpoint.fields.size())));
    std::visit(
        [&]<class T>(std::vector<T>& values) {
          switch (damage.below(6)) {
            case 0:
              values.resize(damage.below(2 * values.size() + 2));
              break;
            case 1:
              column->second = other->second;
              break;
            default:
              if (!values.empty()) {
                values[damage.below(values.size())] =
                    damage.yes() ? values[damage.below(values.size())]
                                 : static_cast<T>(damage.odd_number(values.size()));
              }
          }
        },
        column->second);
  }
}

class DamagedCheckpoint : public ::testing::Test {
 protected:
  fs::path saved() const { return folder_.path() / "saved"; }

  /// Goes on with damaged copies of what is in `saved`, if it can; each stops after some steps.
  void try_all(const char* kind) const {
    const Bytes file = testing::bytes_of(saved() / "checkpoint.clca");
    const Bytes content = content_of(file);
    const store::Checkpoint checkpoint = store::parse_checkpoint(file, kLimit);
    const fs::path broken = folder_.path() / "broken";
    use_damaged(kind, [&](Damage& damage) {
      fs::remove_all(broken);
      fs::copy(saved(), broken, fs::copy_options::recursive);
      fs::remove(broken / "checkpoint-previous.clca");
      Bytes bytes;
      if (damage.below(3) == 0) {
        bytes = store::with_header(kCheckpointKind, damage.damaged(content, content));
      } else {
        store::Checkpoint changed = checkpoint;
        change_columns(changed, damage);
        bytes = store::checkpoint_bytes(changed);
      }
      store::write_whole_file(broken / "checkpoint.clca", bytes);
      std::atomic<int> stop = 0;
      int looks = 0;
      const auto look = [&](const auto& /*at*/) { stop = ++looks < 3 ? 0 : 2; };
      run::resume(run::load_run(broken, kLimit), {.threads = 1, .stop_signal = &stop},
                  {.progress = look, .gas_progress = look, .progress_interval = {}});
    });
    expect_memory_below(4 * kLimit);
  }

  testing::ScratchFolder folder_;
};

TEST_F(DamagedCheckpoint, OfAnAutomatonIsGoneOnWithOrRefused) {
  std::atomic<int> stop = 0;
  run::run(scene::parse(R"(clca: 1
box: {width: 16, height: 20}
species: {grain: {shape: {hexagon: 1}}, rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}}
walls:
  gate: {box: [0, 3, 16, 4]}
  plate: {box: [2, 15, 12, 16], motion: {direction: down, period: 1, distance: 9}, passive: overlap}
sources: {spout: {region: [2, 17, 12, 18], species: {grain: 1}, rate: 0.5}}
outlets: {below: {region: [0, 0, 5, 3]}}
lines: {throat: {from: [0, 6], to: [16, 6], parts: 3}}
stages:
  - {name: packing, fill: {region: [0, 4, 16, 14], counts: {grain: 7, rod: 9}}, until: {steps: 8}}
  - {name: pushing, move: [plate], sources: [spout], until: {steps: 1000000}}
output: {frames: {every: 5, width: 96, height: 64}, series: {every: 1}, trajectory: {every: 4}}
)",
                        "small.yaml"),
           {.folder = saved(), .stop_signal = &stop},
           {.progress = [&](const run::Progress& at) { stop = at.step >= 20 ? 2 : 0; },
            .progress_interval = {}});
  try_all("checkpoints of an automaton");
}

constexpr const char* kContactScene = R"(clca: 1
model: contact
box: {width: 16, height: 20}
species: {grain: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
walls: {gate: {box: [0, 3, 16, 4]}, post: {box: [6, 14, 7, 16]}}
sources: {spout: {region: [2, 17, 12, 18], species: {grain: 1}, rate: 0.05}}
outlets: {below: {region: [0, 0, 5, 3]}}
lines: {throat: {from: [8, 0], to: [8, 12], parts: 3}}
contact: {fall_height: 10}
stages:
  - {name: packing, fill: {region: [0, 4, 16, 14], counts: {grain: 7, large: 2}}, until: {steps: 40}}
  - {name: flow, remove: [gate], sources: [spout], until: {steps: 1000000}}
output: {frames: {every: 50, width: 96, height: 64}, series: {every: 1}, trajectory: {every: 4}}
)";

TEST_F(DamagedCheckpoint, OfTheContactModelIsGoneOnWithOrRefused) {
  std::atomic<int> stop = 0;
  run::run(scene::parse(kContactScene, "small.yaml"), {.folder = saved(), .stop_signal = &stop},
           {.progress = [&](const run::Progress& at) { stop = at.step >= 400 ? 2 : 0; },
            .progress_interval = {}});
  try_all("checkpoints of the contact model");
}

TEST_F(DamagedCheckpoint, OfAGasIsGoneOnWithOrRefused) {
  std::atomic<int> stop = 0;
  run::run(std::get<scene::BoltzmannScene>(
               scene::parse_any_file(CLCA_SOURCE_DIR "/scenes/boltzmann-case1.yaml",
                                     {"boltzmann.particles=50", "boltzmann.ensemble=2"})),
           {.folder = saved(), .stop_signal = &stop},
           {.gas_progress = [&](const run::GasProgress& at) { stop = at.time > 0 ? 2 : 0; },
            .progress_interval = {}});
  try_all("checkpoints of a gas");
}

}  // namespace
}  // namespace clca::damaged_files_test
