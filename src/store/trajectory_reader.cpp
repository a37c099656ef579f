// Reads parts and reconstructs states.

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "clca/store/trajectory.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "store/trajectory_check.hpp"
#include "store/trajectory_files.hpp"
#include "store/trajectory_part.hpp"
#include "store/trajectory_tables.hpp"

namespace clca::store {

namespace {

/// An impossible row.
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

}  // namespace

class Trajectory::Impl {
 public:
  Impl(const std::filesystem::path& run_folder, const scene::Scene& scene, grains::State fixed,
       double max_bytes)
      : fixed_(std::move(fixed)), layout_(layout_of(scene)), bytes_left_(max_bytes) {
    const SceneTables tables(scene, fixed_);
    PartContext context;
    context.stages = scene.stages.size();
    context.most_entered = max_particles(fixed_, max_bytes);
    for (const std::filesystem::path& path : find_parts(run_folder)) {
      context.path = path;
      learn(context, tables);
      const PartFrames& frames = parts_.back().frames;
      context.before += frames.extents();
      context.step = frames.step.back();
      context.stage = frames.stage.back();
      context.entered = frames.entered.back();
    }
  }

  const std::vector<Frame>& frames() const { return frames_; }

  grains::State state(std::size_t frame) {
    const std::size_t number = part_of(frame);
    load(number);
    gather_origins(frame);
    const IndexedPart& part = parts_[number];
    const std::size_t within = frame - first_frame(part);
    grains::State state = fixed_;
    state.step = frames_[frame].step;
    place_particles(state, part, within);
    place_walls(state, within);
    place_pushes(state, part, within);
    check_state(part.context, state);
    return state;
  }

  ContactFrame contact_frame(std::size_t frame) {
    const std::size_t number = part_of(frame);
    load(number);
    const IndexedPart& part = parts_[number];
    const std::size_t within = frame - first_frame(part);
    ContactFrame result;
    if (layout_.velocities) {
      result.velocities.resize(part.frames.entered[within], Eigen::Vector2d::Zero());
      result.spins.resize(part.frames.entered[within], 0);
      const RowSpan rows = part.frames.particles.rows_of(within);
      for (std::size_t row = rows.first; row < rows.end; ++row) {
        result.velocities[rows_.id[row]] = point_at(rows_.velocity, row);
        result.spins[rows_.id[row]] =
            rows_.spin.empty() ? std::numeric_limits<double>::quiet_NaN() : rows_.spin[row];
      }
    }
    if (layout_.contacts) {
      const RowSpan rows = part.frames.contacts.rows_of(within);
      for (std::size_t row = rows.first; row < rows.end; ++row) {
        result.forces.push_back({.upper = rows_.upper[row],
                                 .other = rows_.other[row],
                                 .point = point_at(rows_.point, row),
                                 .normal = point_at(rows_.normal, row),
                                 .branch = point_at(rows_.branch, row),
                                 .along_normal = rows_.force[2 * row],
                                 .along_shear = rows_.force[2 * row + 1]});
      }
    }
    return result;
  }

 private:
  /// Kept for every part: enough to find frames and origins.
  struct IndexedPart {
    PartContext context;
    PartFrames frames;
    PartOrigins origins;

    double bytes() const {
      return static_cast<double>(frames.step.size()) * (kFrameBytes + sizeof(Trajectory::Frame)) +
             static_cast<double>(origins.id.size()) * kOriginBytes;
    }

   private:
    static constexpr double kFrameBytes = 5 * sizeof(std::uint64_t) + 6 * sizeof(std::uint32_t);
    static constexpr double kOriginBytes = 3 * sizeof(std::uint32_t);
  };

  /// Reads and checks the frames and origins of a part.
  void learn(const PartContext& context, const SceneTables& tables) {
    IndexedPart part{.context = context, .frames = {}, .origins = {}};
    SceneTables read;
    std::vector<Hdf5Dataset> datasets = read.datasets();
    for_each_frames_column(part.frames, layout_, add_to(datasets));
    for_each_origins_column(part.origins, add_to(datasets));
    read_hdf5(context.path, kTrajectoryKind, datasets, bytes_left_);
    check_scene(context.path, tables, read);
    check_frames(context, part.frames, layout_);
    check_origins(context, part.frames, part.origins, fixed_.lattice);
    for (std::size_t frame = 0; frame < part.frames.step.size(); ++frame) {
      frames_.push_back({.step = part.frames.step[frame],
                         .stage = part.frames.stage[frame],
                         .particles = part.frames.particles.count[frame]});
    }
    bytes_left_ -= part.bytes();
    parts_.push_back(std::move(part));
  }

  static std::size_t first_frame(const IndexedPart& part) {
    return static_cast<std::size_t>(part.context.before.frames);
  }

  std::size_t part_of(std::size_t frame) const {
    if (frame >= frames_.size()) {
      throw std::out_of_range("a trajectory has no such frame");
    }
    const auto after = std::upper_bound(
        parts_.begin(), parts_.end(), frame,
        [](std::size_t f, const IndexedPart& part) { return f < part.context.before.frames; });
    return static_cast<std::size_t>(after - parts_.begin()) - 1;
  }

  void load(std::size_t part) {
    if (loaded_ == part) {
      return;
    }
    loaded_.reset();
    rows_ = {};
    const IndexedPart& known = parts_[part];
    std::vector<Hdf5Dataset> datasets;
    for_each_rows_column(rows_, layout_, add_to(datasets));
    read_hdf5(known.context.path, kTrajectoryKind, datasets, bytes_left_);
    check_rows(known.context, known.frames, rows_, fixed_, layout_);
    loaded_ = part;
  }

  /// Origins of particles that were present in a frame of the stage so far.
  void gather_origins(std::size_t frame) {
    const bool goes_on = origins_frame_ && *origins_frame_ <= frame &&
                         frames_[*origins_frame_].stage == frames_[frame].stage;
    if (!goes_on) {
      const auto begin = std::find_if(frames_.begin(), frames_.end(), [&](const Frame& other) {
        return other.stage == frames_[frame].stage;
      });
      origins_.clear();
      take_origins(static_cast<std::size_t>(begin - frames_.begin()));
    }
    while (*origins_frame_ < frame) {
      take_origins(*origins_frame_ + 1);
    }
  }

  void take_origins(std::size_t frame) {
    const IndexedPart& part = parts_[part_of(frame)];
    const std::size_t within = frame - first_frame(part);
    origins_.resize(part.frames.entered[within], kUnknown);
    const RowSpan rows = part.frames.origins.rows_of(within);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      origins_[part.origins.id[row]] = site_at(part.origins.site, row);
    }
    origins_frame_ = frame;
  }

  void place_particles(grains::State& state, const IndexedPart& part, std::size_t frame) const {
    state.particles.assign(origins_.size(), {.present = false});
    state.origins.assign(origins_.size(), {});
    const RowSpan rows = part.frames.particles.rows_of(frame);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      const std::uint32_t id = rows_.id[row];
      const lattice::Site site = site_at(rows_.site, row);
      state.particles[id] = {.column = site.column,
                             .row = site.row,
                             .kind = rows_.kind[row],
                             .previous = rows_.move[row]};
      state.origins[id] = origins_[id];
      if (origins_[id] == kUnknown) {
        refuse_frame(part.context, state.step, "a particle without an origin");
      }
    }
  }

  void place_walls(grains::State& state, std::size_t frame) const {
    for (std::size_t wall = 0; wall < state.walls.size(); ++wall) {
      const std::size_t at = frame * state.walls.size() + wall;
      state.walls[wall].present = rows_.wall_present[at] != 0;
      state.walls[wall].travel.offset = rows_.wall_offset[at];
    }
  }

  void place_pushes(grains::State& state, const IndexedPart& part, std::size_t frame) const {
    const RowSpan rows = part.frames.pushes.rows_of(frame);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
      state.pushes.push_back(
          {.pushed = rows_.pushed[row],
           .pusher = rows_.pusher[row],
           .source = rows_.push_source[row],
           .direction = static_cast<lattice::Direction>(rows_.push_direction[row])});
    }
  }

  grains::State fixed_;
  Layout layout_;
  double bytes_left_;  // that reading a part may take
  std::vector<IndexedPart> parts_;
  std::vector<Frame> frames_;
  std::optional<std::size_t> loaded_;  // the part of rows_
  PartRows rows_;
  std::optional<std::size_t> origins_frame_;  // the frame of origins_
  std::vector<lattice::Site> origins_;        // by id
};

Trajectory::Trajectory(const std::filesystem::path& run_folder, const scene::Scene& scene,
                       grains::State fixed, double max_bytes)
    : impl_(std::make_unique<Impl>(run_folder, scene, std::move(fixed), max_bytes)) {}
Trajectory::~Trajectory() = default;

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
