// Finds and reads parts, and reconstructs states. What could lead out of a list, out of the box or
// to more memory than the limit is refused.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "clca/grains/occupancy.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/trajectory.hpp"
#include "clca/text/read.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

/// A part, of which frames and origins are kept: enough to find others.
struct IndexedPart {
  std::filesystem::path path;
  RowCounts before;  ///< of the parts before
  TrajectoryPart content;

  double bytes() const {
    constexpr double kFrameBytes = 5 * sizeof(std::uint64_t) + 6 * sizeof(std::uint32_t);
    constexpr double kOriginBytes = 3 * sizeof(std::uint32_t);
    return static_cast<double>(content.frames.step.size()) *
               (kFrameBytes + sizeof(Trajectory::Frame)) +
           static_cast<double>(content.origins.id.size()) * kOriginBytes;
  }
};

namespace {

constexpr lattice::Site kUnknown = {0, -1};

lattice::Site site_at(const std::vector<std::int32_t>& sites, std::size_t row) {
  return {sites[2 * row], sites[2 * row + 1]};
}

Eigen::Vector2d point_at(const std::vector<double>& points, std::size_t row) {
  return {points[2 * row], points[2 * row + 1]};
}

/// Number of particles whose state and checks fit into `bytes`.
std::size_t max_particles(const grains::State& fixed, double bytes) {
  constexpr double kParticleBytes = sizeof(grains::Particle) + sizeof(lattice::Site) + 1;
  const double occupancy =
      grains::OccupancyTable::bytes_for(static_cast<double>(fixed.lattice.index_count()), true);
  constexpr double kMaxIds = std::numeric_limits<grains::Owner>::max();
  return static_cast<std::size_t>(std::clamp((bytes - occupancy) / kParticleBytes, 0.0, kMaxIds));
}

void require(bool well, const IndexedPart& part, const char* reason) {
  if (!well) {
    refuse_part(part.path, reason);
  }
}

void require_in_frame(bool well, const IndexedPart& part, std::uint64_t step, const char* reason) {
  if (!well) {
    refuse_part(part.path, fmt::format("frame of step {}: {}", step, reason));
  }
}

void check_ranges(const IndexedPart& part, RowKind row_kind) {
  const RowRanges& ranges = part.content.frames.row_ranges[row_kind];
  std::uint64_t first = part.before[row_kind];
  for (std::size_t frame = 0; frame < ranges.first_rows.size(); ++frame) {
    require(ranges.first_rows[frame] == first, part, "rows of frames do not follow each other");
    first += ranges.row_counts[frame];
  }
}

void check_ids(const IndexedPart& part, const std::vector<std::uint32_t>& ids,
               const RowRanges& ranges) {
  const PartFrames& frames = part.content.frames;
  for (std::size_t frame = 0; frame < frames.step.size(); ++frame) {
    const RowSpan rows = ranges.rows_of(frame);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      require_in_frame(ids[row] < frames.entered_particles[frame] &&
                           (row == rows.first || ids[row - 1] < ids[row]),
                       part, frames.step[frame], "ids out of order or out of range");
    }
  }
}

/// Reads the columns of a use, with what else there is in the file.
std::vector<TrajectoryDataset> read_columns(const std::filesystem::path& path, TrajectoryPart& part,
                                            const OptionalDatasets& layout, DatasetUse use,
                                            double max_bytes, std::vector<Hdf5Dataset> datasets) {
  std::vector<TrajectoryDataset> columns = part.datasets(layout);
  std::erase_if(columns, [use](const TrajectoryDataset& column) { return column.use != use; });
  datasets.insert(datasets.end(), columns.begin(), columns.end());
  read_hdf5(path, kTrajectoryKind, datasets, max_bytes);
  return columns;
}

/// Throws StoreError unless the columns have as many rows as the frames say.
void check_rows(const std::filesystem::path& path, const std::vector<TrajectoryDataset>& columns,
                const RowCounts& row_counts) {
  for (const TrajectoryDataset& column : columns) {
    const std::size_t numbers =
        std::visit([](const auto* list) { return list->size(); }, column.values);
    const std::size_t rows = numbers / column.numbers_per_row;
    const bool missing = column.may_be_missing && numbers == 0;
    if (!missing && rows != row_counts[column.row_kind]) {
      refuse_part(path, fmt::format("{} has {} rows, not {}", column.path, rows,
                                    row_counts[column.row_kind]));
    }
  }
}

std::optional<std::uint64_t> part_number(const std::string& name) {
  constexpr std::string_view kBegin = "part-";
  if (!name.starts_with(kBegin)) {
    return std::nullopt;
  }
  const std::string rest = name.substr(kBegin.size());
  const auto number = text::number<std::uint64_t>(rest.substr(0, rest.find('.')));
  return number && name == part_name(*number) ? number : std::nullopt;
}

}  // namespace

std::string part_name(std::uint64_t number) {
  return fmt::format("part-{:06}.h5", number);
}

std::set<std::uint64_t> part_numbers(const std::filesystem::path& folder) {
  std::set<std::uint64_t> numbers;
  std::error_code error;
  std::filesystem::directory_iterator it(folder, error);
  for (; !error && it != std::filesystem::directory_iterator(); it.increment(error)) {
    if (const auto number = part_number(it->path().filename())) {
      numbers.insert(*number);
    }
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    throw StoreError(
        fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  }
  return numbers;
}

std::vector<std::filesystem::path> find_parts(const std::filesystem::path& run_folder) {
  const std::filesystem::path folder = run_folder / kTrajectoryFolder;
  std::vector<std::filesystem::path> parts;
  for (const std::uint64_t number : part_numbers(folder)) {
    const std::filesystem::path next = folder / part_name(parts.size());
    if (number != parts.size()) {
      refuse_part(next, "missing, though later parts are there");
    }
    parts.push_back(next);
  }
  if (parts.empty()) {
    refuse_part(folder,
                "no part there; a run writes them at checkpoints, after 16 MiB and at its end");
  }
  return parts;
}

void check_trajectory_parts(const std::filesystem::path& run_folder) {
  for (const std::filesystem::path& part : find_parts(run_folder)) {
    read_hdf5(part, kTrajectoryKind, {}, kNoByteLimit);
  }
}

TrajectoryPart read_index(const std::filesystem::path& path, const SceneTables& tables,
                          const OptionalDatasets& layout, double max_bytes) {
  TrajectoryPart part;
  SceneTables read;
  const auto columns =
      read_columns(path, part, layout, DatasetUse::index, max_bytes, read.datasets());
  tables.require_same(read, path);
  if (part.frames.step.empty()) {
    refuse_part(path, "no frames");
  }
  check_rows(path, columns, part.frames.total_rows());
  return part;
}

PartRows read_rows(const std::filesystem::path& path, const PartFrames& frames,
                   const OptionalDatasets& layout, double max_bytes) {
  TrajectoryPart part;
  const auto columns = read_columns(path, part, layout, DatasetUse::rows, max_bytes, {});
  check_rows(path, columns, frames.total_rows());
  return std::move(part.rows);
}

class Trajectory::Impl {
 public:
  Impl(const std::filesystem::path& run_folder, const scene::Scene& scene, grains::State fixed,
       double max_bytes)
      : fixed_(std::move(fixed)),
        layout_(optional_datasets(scene)),
        most_entered_(max_particles(fixed_, max_bytes)),
        bytes_left_(max_bytes) {
    const auto finished = finished_summary(run_folder);  // first: parts may be added meanwhile
    const SceneTables tables(scene, fixed_);
    RowCounts before;
    for (const std::filesystem::path& path : find_parts(run_folder)) {
      const IndexedPart& part = parts_.emplace_back(
          IndexedPart{path, before, read_index(path, tables, layout_, bytes_left_)});
      add_frames(part, tables.stages.size());
      before += part.content.frames.total_rows();
      bytes_left_ -= part.bytes();
    }
    if (finished && frames_.back().step < finished->steps) {
      refuse_part(run_folder / kTrajectoryFolder / part_name(parts_.size()),
                  "missing, though the run had written it");
    }
  }

  const std::vector<Frame>& frames() const { return frames_; }

  grains::State state(std::size_t frame) {
    const auto [part, within] = loaded(frame);
    gather_origins(frame);
    grains::State state = fixed_;
    state.step = frames_[frame].step;
    state.particles.assign(origins_.size(), {.present = false});
    state.origins.assign(origins_.size(), {});
    const RowSpan particles = part->content.frames.row_ranges[RowKind::particles].rows_of(within);
    for (std::size_t row = particles.first; row < particles.end; ++row) {
      const std::uint32_t id = rows_.id[row];
      const lattice::Site site = site_at(rows_.site, row);
      state.particles[id] = {.column = site.column,
                             .row = site.row,
                             .kind = rows_.kind[row],
                             .previous = rows_.last_move[row]};
      state.origins[id] = origins_[id];
      require_in_frame(origins_[id] != kUnknown, *part, state.step, "a particle without an origin");
    }
    for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
      const std::size_t at = within * state.walls.size() + wall;
      require_in_frame(rows_.wall_present[at] <= 1, *part, state.step,
                       "a wall neither present nor absent");
      state.walls[wall].present = rows_.wall_present[at] == 1;
      state.walls[wall].travel.offset = rows_.wall_offset[at];
    }
    const RowSpan pushes = part->content.frames.row_ranges[RowKind::pushes].rows_of(within);
    for (std::size_t row = pushes.first; row < pushes.end; ++row) {
      state.pushes.push_back(
          {.pushed = rows_.pushed[row],
           .pusher = rows_.pusher[row],
           .source = rows_.push_source[row],
           .direction = static_cast<lattice::Direction>(rows_.push_direction[row])});
    }
    try {
      check_valid(state);
      const grains::Occupancy checked(state);
    } catch (const std::logic_error& error) {
      require_in_frame(false, *part, state.step, error.what());
    }
    return state;
  }

  ContactFrame contact_frame(std::size_t frame) {
    const auto [part, within] = loaded(frame);
    const PartFrames& frames = part->content.frames;
    const std::size_t entered = frames.entered_particles[within];
    ContactFrame result;
    if (layout_.has_velocities) {
      result.velocities.resize(entered, Eigen::Vector2d::Zero());
      result.spins.resize(entered, 0);
      const RowSpan rows = frames.row_ranges[RowKind::particles].rows_of(within);
      for (std::size_t row = rows.first; row < rows.end; ++row) {
        result.velocities[rows_.id[row]] = point_at(rows_.velocity, row);
        result.spins[rows_.id[row]] =
            rows_.spin.empty() ? std::numeric_limits<double>::quiet_NaN() : rows_.spin[row];
      }
    }
    if (layout_.has_contacts) {
      const RowSpan rows = frames.row_ranges[RowKind::contacts].rows_of(within);
      for (std::size_t row = rows.first; row < rows.end; ++row) {
        const grains::Owner other = rows_.contact_other[row];
        const bool is_there =
            grains::is_particle(other)
                ? grains::particle_id(other) < entered
                : contact::is_side(other) || (grains::is_obstacle(other) &&
                                              grains::wall_number(other) < fixed_.walls.size());
        require_in_frame(rows_.contact_upper[row] < entered && is_there, *part, frames_[frame].step,
                         "a contact of bodies that are not there");
        result.forces.push_back({.upper = rows_.contact_upper[row],
                                 .other = other,
                                 .point = point_at(rows_.contact_point, row),
                                 .normal = point_at(rows_.contact_normal, row),
                                 .branch = point_at(rows_.contact_branch, row),
                                 .normal_force = rows_.contact_force[2 * row],
                                 .shear_force = rows_.contact_force[2 * row + 1]});
      }
    }
    return result;
  }

 private:
  void add_frames(const IndexedPart& part, std::size_t stages) {
    const PartFrames& frames = part.content.frames;
    for (std::size_t frame = 0; frame < frames.step.size(); ++frame) {
      const Frame last = frames_.empty() ? Frame() : frames_.back();
      const Frame next = {.step = frames.step[frame],
                          .stage = frames.stage[frame],
                          .particles = frames.row_ranges[RowKind::particles].row_counts[frame]};
      require(next.step >= last.step && next.stage >= last.stage, part, "frames are not in order");
      require_in_frame(next.stage < stages, part, next.step,
                       "a stage that the scene does not have");
      require_in_frame(frames.entered_particles[frame] <= most_entered_, part, next.step,
                       "needs more memory than the limit");
      frames_.push_back(next);
    }
    for (const RowKind row_kind : kKindsInFrames) {
      check_ranges(part, row_kind);
    }
    check_ids(part, part.content.origins.id, frames.row_ranges[RowKind::origins]);
  }

  /// The part of a frame, and the place of the frame in it.
  std::pair<const IndexedPart*, std::size_t> found(std::size_t frame) const {
    if (frame >= frames_.size()) {
      throw std::out_of_range("a trajectory has no such frame");
    }
    const auto after = std::ranges::upper_bound(
        parts_, frame, {}, [](const IndexedPart& part) { return part.before[RowKind::frames]; });
    const IndexedPart& part = *std::prev(after);
    return {&part, frame - static_cast<std::size_t>(part.before[RowKind::frames])};
  }

  /// The same, with the rows of the part in rows_.
  std::pair<const IndexedPart*, std::size_t> loaded(std::size_t frame) {
    const auto place = found(frame);
    const IndexedPart& part = *place.first;
    if (loaded_ != &part) {
      loaded_ = nullptr;
      rows_ = {};
      auto rows = read_rows(part.path, part.content.frames, layout_, bytes_left_);
      check_ids(part, rows.id, part.content.frames.row_ranges[RowKind::particles]);
      rows_ = std::move(rows);
      loaded_ = &part;
    }
    return place;
  }

  /// Origins of particles that were present in a frame of the stage so far.
  void gather_origins(std::size_t frame) {
    const bool goes_on = origins_frame_ && *origins_frame_ <= frame &&
                         frames_[*origins_frame_].stage == frames_[frame].stage;
    if (!goes_on) {
      const auto begin = std::ranges::find_if(
          frames_, [&](const Frame& other) { return other.stage == frames_[frame].stage; });
      origins_.clear();
      take_origins(static_cast<std::size_t>(begin - frames_.begin()));
    }
    while (*origins_frame_ < frame) {
      take_origins(*origins_frame_ + 1);
    }
  }

  void take_origins(std::size_t frame) {
    const auto [part, within] = found(frame);
    const TrajectoryPart& content = part->content;
    origins_.resize(content.frames.entered_particles[within], kUnknown);
    const RowSpan rows = content.frames.row_ranges[RowKind::origins].rows_of(within);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      origins_[content.origins.id[row]] = site_at(content.origins.site, row);
    }
    origins_frame_ = frame;
  }

  grains::State fixed_;
  OptionalDatasets layout_;
  std::size_t most_entered_;  // particles whose state fits into memory
  double bytes_left_;         // that reading a part may take
  std::vector<IndexedPart> parts_;
  std::vector<Frame> frames_;
  const IndexedPart* loaded_ = nullptr;  // the part of rows_
  PartRows rows_;
  std::optional<std::size_t> origins_frame_;  // the frame of origins_
  std::vector<lattice::Site> origins_;        // by id
};

Trajectory::Trajectory(const std::filesystem::path& run_folder, const scene::Scene& scene,
                       grains::State fixed, double max_bytes)
    : impl_(std::make_shared<Impl>(run_folder, scene, std::move(fixed), max_bytes)) {}

const std::vector<Trajectory::Frame>& Trajectory::frames() const {
  return impl_->frames();
}
grains::State Trajectory::state(std::size_t frame) const {
  return impl_->state(frame);
}
ContactFrame Trajectory::contact_frame(std::size_t frame) const {
  return impl_->contact_frame(frame);
}

}  // namespace clca::store
