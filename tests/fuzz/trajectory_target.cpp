// Trajectories with right checksums that hold what no run has written: refused, or read
// as states that an automaton can go on with, and within the limit of memory.

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <variant>

#include "choices.hpp"
#include "clca/automaton/automaton.hpp"
#include "clca/model/initial_state.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "memory_meter.hpp"
#include "scratch_file.hpp"
#include "small_run.hpp"
#include "store/hdf5.hpp"
#include "store/trajectory_part.hpp"

namespace {

namespace automaton = clca::automaton;
namespace fuzz = clca::fuzz;
namespace grains = clca::grains;
namespace model = clca::model;
namespace store = clca::store;

constexpr std::size_t kWalls = 2;
constexpr store::OptionalDatasets kLayout = {.wall_count = kWalls};
constexpr std::size_t kFramesInFirst = 5;
constexpr std::uint32_t kMaxLimit = 1U << 23U;
constexpr double kBeside = 3e6;  // names, the state itself, what is checked of it

/// A run folder whose two parts lie in memory.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "clca-fuzz-XXXXXX").string();
    fuzz::require(::mkdtemp(name.data()) != nullptr, "no folder");
    path_ = name;
    const auto parts = path_ / store::kTrajectoryFolder;
    std::filesystem::create_directory(parts);
    for (std::size_t part = 0; part < files_.size(); ++part) {
      std::filesystem::create_symlink(files_[part].path(), parts / store::part_name(part));
    }
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void hold(std::size_t part, std::span<const std::uint8_t> bytes) const {
    files_.at(part).hold(bytes);
  }

 private:
  std::array<fuzz::ScratchFile, 2> files_;
  std::filesystem::path path_;
};

using Parts = std::array<store::TrajectoryPart, 2>;

Parts parts_of(const std::vector<fuzz::SmallFrame>& frames) {
  Parts parts;
  store::RowCounts before;
  std::size_t entered = 0;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const auto& [state, stage, begins] = frames[frame];
    before = frame < kFramesInFirst ? store::RowCounts() : parts.front().frames.total_rows();
    parts.at(frame < kFramesInFirst ? 0 : 1)
        .add_frame(state, stage, begins ? 0 : entered, before, {});
    entered = state.particles.size();
  }
  return parts;
}

template <class T>
void change_values(const store::TrajectoryDataset& column, std::vector<T>& values,
                   fuzz::Choices& choices) {
  constexpr std::uint32_t kMaxRows = 100;
  const auto any_place = [&] { return choices.up_to(0xFF) % values.size(); };
  const std::size_t how = choices.up_to(3);
  if (how == 0) {
    values.resize(column.numbers_per_row * choices.up_to(kMaxRows));
  } else if (!values.empty()) {
    T& value = values[any_place()];
    value = how == 1   ? values[any_place()]
            : how == 2 ? static_cast<T>(choices.up_to(0xFF))
                       : choices.any<T>();
  }
}

/// As long as the numbers of rows have it, which follow each other.
void make_fit(store::TrajectoryPart& part, const store::RowCounts& before) {
  constexpr std::uint64_t kMaxRows = 10'000;
  const auto follow = [](store::RowRanges& ranges, std::uint64_t first) {
    ranges.row_counts.resize(ranges.first_rows.size());
    std::exclusive_scan(ranges.row_counts.begin(), ranges.row_counts.end(),
                        ranges.first_rows.begin(), first);
  };
  follow(part.frames.row_ranges[store::RowKind::particles], before[store::RowKind::particles]);
  follow(part.frames.row_ranges[store::RowKind::origins], before[store::RowKind::origins]);
  follow(part.frames.row_ranges[store::RowKind::pushes], before[store::RowKind::pushes]);
  const store::RowCounts row_counts = part.frames.total_rows();
  for (const store::TrajectoryDataset& column : part.datasets(kLayout)) {
    const std::size_t numbers =
        column.numbers_per_row * std::min(row_counts[column.row_kind], kMaxRows);
    std::visit([numbers](auto* values) { values->resize(numbers); }, column.values);
  }
}

/// A dataset that is not written; none is a number beyond all.
using Omitted = std::size_t;
constexpr std::size_t kColumns = 25;

/// Changes and says which dataset is to be left out of that part.
Omitted change(store::TrajectoryPart& part, const store::RowCounts& before,
               fuzz::Choices& choices) {
  for (std::size_t changes = choices.up_to(6); changes > 0; --changes) {
    const std::vector<store::TrajectoryDataset> columns = part.datasets(kLayout);
    const std::size_t number = choices.up_to(kColumns - 1);
    if (number >= columns.size()) {
      continue;
    }
    const store::TrajectoryDataset& column = columns[number];
    std::visit(
        [&]<class T>(T* values) {
          if constexpr (store::Number<typename T::value_type>) {
            change_values(column, *values, choices);
          }
        },
        column.values);
  }
  if (choices.yes()) {
    make_fit(part, before);
  }
  return choices.yes() ? choices.up_to(kColumns - 1) : kColumns;
}

std::vector<std::uint8_t> file_of(store::TrajectoryPart& part, Omitted omitted) {
  static store::SceneTables tables(fuzz::small_scene(), model::initial_state(fuzz::small_scene()));
  const auto add_all = [&](const store::hdf5::Handle& file) {
    for (const store::Hdf5Dataset& dataset : tables.datasets()) {
      store::hdf5::add_dataset(file, dataset);
    }
    const std::vector<store::TrajectoryDataset> columns = part.datasets(kLayout);
    for (std::size_t at = 0; at < columns.size(); ++at) {
      if (at != omitted) {
        store::hdf5::add_dataset(file, columns[at]);
      }
    }
  };
  return store::with_header(store::kTrajectoryKind, store::hdf5::file_bytes("part", add_all));
}

/// An automaton goes on from it, and its frame is that of the file.
void require_sound(const grains::State& state, const store::TrajectoryPart& part,
                   std::size_t frame) {
  automaton::Automaton(state, fuzz::small_scene().automaton_rules).step();
  store::TrajectoryPart again;
  again.add_frame(state, part.frames.stage[frame], 0, {}, {});
  const auto same = [](const auto& all, store::RowSpan rows, const auto& some, std::size_t width) {
    return std::equal(all.begin() + static_cast<std::ptrdiff_t>(width * rows.first),
                      all.begin() + static_cast<std::ptrdiff_t>(width * rows.end), some.begin(),
                      some.end());
  };
  const store::RowSpan particles = part.frames.row_ranges[store::RowKind::particles].rows_of(frame);
  const store::RowSpan pushes = part.frames.row_ranges[store::RowKind::pushes].rows_of(frame);
  const store::RowSpan itself = {frame, frame + 1};
  fuzz::require(
      same(part.frames.step, itself, again.frames.step, 1) &&
          same(part.frames.entered_particles, itself, again.frames.entered_particles, 1) &&
          same(part.rows.id, particles, again.rows.id, 1) &&
          same(part.rows.site, particles, again.rows.site, 2) &&
          same(part.rows.kind, particles, again.rows.kind, 1) &&
          same(part.rows.last_move, particles, again.rows.last_move, 1) &&
          same(part.rows.pushed, pushes, again.rows.pushed, 1) &&
          same(part.rows.pusher, pushes, again.rows.pusher, 1) &&
          same(part.rows.push_source, pushes, again.rows.push_source, 1) &&
          same(part.rows.push_direction, pushes, again.rows.push_direction, 1) &&
          same(part.rows.wall_present, itself, again.rows.wall_present, kWalls) &&
          same(part.rows.wall_offset, itself, again.rows.wall_offset, kWalls),
      "another frame than that of the file");
}

/// Reads as many frames as there are, each refused or sound; returns how many were.
std::size_t read(const Folder& folder, const Parts& parts, double limit) {
  std::size_t sound = 0;
  try {
    const store::Trajectory trajectory(folder.path(), fuzz::small_scene(),
                                       model::initial_state(fuzz::small_scene()), limit);
    const std::size_t in_first = parts.front().frames.step.size();
    for (std::size_t frame = 0; frame < trajectory.frames().size(); ++frame) {
      try {
        const grains::State state = trajectory.state(frame);
        const bool first = frame < in_first;
        require_sound(state, parts.at(first ? 0 : 1), first ? frame : frame - in_first);
        ++sound;
      } catch (const store::StoreError&) {
        continue;
      }
    }
  } catch (const store::StoreError&) {
    return sound;
  }
  return sound;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  static const std::vector<fuzz::SmallFrame> frames = fuzz::small_run();
  static const Parts whole = parts_of(frames);
  fuzz::require(!whole[0].rows.pushed.empty() || !whole[1].rows.pushed.empty(),
                "nothing is pushed");
  fuzz::Choices choices({data, size});
  Parts parts = whole;
  folder.hold(0, file_of(parts[0], change(parts[0], {}, choices)));
  folder.hold(1, file_of(parts[1], change(parts[1], parts[0].frames.total_rows(), choices)));
  const double limit = kMaxLimit - static_cast<double>(choices.up_to(kMaxLimit));
  const fuzz::MemoryMeter meter;
  const std::size_t sound = read(folder, parts, limit);
  fuzz::require(size > 0 || sound == frames.size(), "a run is not read");
  fuzz::require(meter.max_bytes() <= limit + kBeside, "took " + std::to_string(meter.max_bytes()) +
                                                          " bytes, not " + std::to_string(limit));
  return 0;
}
