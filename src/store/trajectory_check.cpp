#include "store/trajectory_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "clca/grains/occupancy.hpp"
#include "clca/store/file.hpp"

namespace clca::store {

namespace {

/// Columns are not wrapped at a periodic boundary; limited so that differences do not overflow.
constexpr std::int32_t kMaxColumn = std::int32_t{1} << 28;

void require(bool well, const PartContext& context, const char* reason) {
  if (!well) {
    throw StoreError(fmt::format("cannot read {}: {}", context.path.string(), reason));
  }
}

void require_in_frame(bool well, const PartContext& context, std::uint64_t step,
                      const char* reason) {
  if (!well) {
    refuse_frame(context, step, reason);
  }
}

bool is_inside(const lattice::Lattice& lattice, std::int32_t column, std::int32_t row) {
  return column >= -kMaxColumn && column <= kMaxColumn && lattice.contains({column, row});
}

bool ascend(const std::vector<std::uint32_t>& ids, RowSpan rows, std::uint32_t end) {
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (ids[row] >= end || (row > rows.first && ids[row - 1] >= ids[row])) {
      return false;
    }
  }
  return true;
}

bool all_inside(const lattice::Lattice& lattice, const std::vector<std::int32_t>& sites) {
  for (std::size_t at = 0; at < sites.size(); at += 2) {
    if (!is_inside(lattice, sites[at], sites[at + 1])) {
      return false;
    }
  }
  return true;
}

/// Datasets must have equal lengths.
template <class... Lists>
bool have_size(std::size_t size, const Lists&... lists) {
  return ((lists.size() == size) && ...);
}

template <class T>
bool all_below(const std::vector<T>& values, std::size_t end) {
  return std::all_of(values.begin(), values.end(), [end](T value) { return value < end; });
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

void check_ranges(const PartContext& context, const RowRanges& ranges, std::uint64_t first) {
  for (std::size_t frame = 0; frame < ranges.first.size(); ++frame) {
    require(ranges.first[frame] == first, context, "rows of frames do not follow each other");
    first += ranges.count[frame];
  }
}

void check_wall_rows(const PartContext& context, const PartFrames& frames, const PartRows& rows,
                     const std::vector<grains::Wall>& walls) {
  const std::size_t size = frames.step.size() * walls.size();
  require(have_size(size, rows.wall_present, rows.wall_offset), context,
          "walls and frames do not go together");
  require(all_below(rows.wall_present, 2), context, "a wall neither present nor absent");
  for (std::size_t at = 0; at < size; ++at) {
    const grains::Wall& wall = walls[at % walls.size()];
    const grains::OffsetRange range =
        wall.motion ? grains::range_of(*wall.motion) : grains::OffsetRange{};
    require_in_frame(rows.wall_offset[at] >= range.low && rows.wall_offset[at] <= range.high,
                     context, frames.step[at / walls.size()], "a wall where it cannot come");
  }
}

/// The grain is present, the other body exists, and the contact is near the grain.
bool is_contact(const PartRows& rows, RowSpan particles, std::size_t row,
                const grains::State& fixed) {
  const auto first = rows.id.begin() + static_cast<std::ptrdiff_t>(particles.first);
  const auto end = rows.id.begin() + static_cast<std::ptrdiff_t>(particles.end);
  const auto upper = std::lower_bound(first, end, rows.upper[row]);
  const grains::Owner other = rows.other[row];
  const bool has_other =
      grains::is_particle(other)
          ? std::binary_search(first, end, grains::particle_id(other))
          : contact::is_side(other) ||
                (grains::is_wall(other) && grains::wall_number(other) < fixed.walls.size());
  if (upper == end || *upper != rows.upper[row] || !has_other) {
    return false;
  }
  const auto at = static_cast<std::size_t>(upper - rows.id.begin());
  const lattice::Site site = {fixed.lattice.wrapped(rows.site[2 * at]), rows.site[2 * at + 1]};
  const Eigen::Vector2d point(rows.point[2 * row], rows.point[2 * row + 1]);
  return (fixed.lattice.in_box(point) - lattice::position(site)).norm() <=
         2 * fixed.lattice.size().norm();
}

void check_contact_rows(const PartContext& context, const PartFrames& frames, const PartRows& rows,
                        const grains::State& fixed) {
  const auto contacts = static_cast<std::size_t>(frames.extents().contacts);
  require(have_size(contacts, rows.upper, rows.other) &&
              have_size(2 * contacts, rows.point, rows.normal, rows.branch, rows.force),
          context, "contacts and frames do not go together");
  require(all_finite(rows.point) && all_finite(rows.normal) && all_finite(rows.branch) &&
              all_finite(rows.force),
          context, "a number of a contact that is not finite");
  for (std::size_t frame = 0; frame < frames.step.size(); ++frame) {
    const RowSpan span = frames.contacts.rows_of(frame);
    for (std::size_t row = span.first; row < span.end; ++row) {
      require_in_frame(is_contact(rows, frames.particles.rows_of(frame), row, fixed), context,
                       frames.step[frame], "a contact that cannot be");
    }
  }
}

/// Both bodies of a push must be present, and the wall of its origin must be one that overlaps.
bool is_push(const grains::State& state, const grains::Push& push) {
  const auto is_present = [&state](std::size_t id) {
    return id < state.particles.size() && state.particles[id].present;
  };
  const grains::Owner pusher = push.pusher;
  const bool has_pusher =
      grains::is_particle(pusher)
          ? is_present(static_cast<std::size_t>(pusher)) &&
                static_cast<std::uint32_t>(pusher) != push.pushed
          : grains::is_wall(pusher) && grains::wall_number(pusher) < state.walls.size();
  return has_pusher && is_present(push.pushed) && push.source < state.walls.size() &&
         state.walls[push.source].lets_overlap();
}

bool are_in_order(const std::vector<grains::Push>& pushes) {
  return std::adjacent_find(pushes.begin(), pushes.end(), [](const auto& one, const auto& next) {
           return std::pair(one.pushed, one.pusher) >= std::pair(next.pushed, next.pusher);
         }) == pushes.end();
}

bool overlap(const grains::State& state, const grains::Occupancy& occupancy,
             const grains::Push& push) {
  const grains::Particle& particle = state.particles[push.pushed];
  const auto& sites = state.shape(particle).sites();
  return std::any_of(sites.begin(), sites.end(), [&](lattice::Axial part) {
    return occupancy.has(state.lattice.index(particle.site() + part), push.pusher);
  });
}

}  // namespace

void refuse_frame(const PartContext& context, std::uint64_t step, const std::string& reason) {
  throw StoreError(
      fmt::format("cannot read {}: frame of step {}: {}", context.path.string(), step, reason));
}

void check_scene(const std::filesystem::path& path, const SceneTables& scene,
                 const SceneTables& read) {
  const std::string difference = scene.difference(read);
  if (!difference.empty()) {
    throw StoreError(
        fmt::format("cannot read {}: of another scene: {}", path.string(), difference));
  }
}

void check_frames(const PartContext& context, const PartFrames& frames, const Layout& layout) {
  const std::size_t size = frames.step.size();
  require(size > 0, context, "no frames");
  require(have_size(size, frames.stage, frames.entered, frames.particles.first,
                    frames.particles.count, frames.origins.first, frames.origins.count,
                    frames.pushes.first, frames.pushes.count) &&
              have_size(layout.contacts ? size : 0, frames.contacts.first, frames.contacts.count),
          context, "datasets of frames have different lengths");
  PartContext last = context;
  for (std::size_t frame = 0; frame < size; ++frame) {
    require(frames.step[frame] >= last.step && frames.stage[frame] >= last.stage &&
                frames.entered[frame] >= last.entered,
            context, "frames are not in order");
    last.step = frames.step[frame];
    last.stage = frames.stage[frame];
    last.entered = frames.entered[frame];
    require_in_frame(last.stage < context.stages, context, last.step,
                     "a stage that the scene does not have");
    require_in_frame(last.entered <= context.most_entered, context, last.step,
                     "needs more memory than the limit");
    require_in_frame(frames.particles.count[frame] <= last.entered &&
                         frames.origins.count[frame] <= frames.particles.count[frame],
                     context, last.step, "more rows than particles");
  }
  check_ranges(context, frames.particles, context.before.particles);
  check_ranges(context, frames.origins, context.before.origins);
  check_ranges(context, frames.pushes, context.before.pushes);
  check_ranges(context, frames.contacts, context.before.contacts);
}

void check_origins(const PartContext& context, const PartFrames& frames, const PartOrigins& origins,
                   const lattice::Lattice& lattice) {
  const auto rows = static_cast<std::size_t>(frames.extents().origins);
  require(have_size(rows, origins.id) && have_size(2 * rows, origins.site), context,
          "origins and frames do not go together");
  require(all_inside(lattice, origins.site), context, "an origin outside the box");
  for (std::size_t frame = 0; frame < frames.step.size(); ++frame) {
    require_in_frame(ascend(origins.id, frames.origins.rows_of(frame), frames.entered[frame]),
                     context, frames.step[frame], "ids of origins out of order or out of range");
  }
}

void check_rows(const PartContext& context, const PartFrames& frames, const PartRows& rows,
                const grains::State& fixed, const Layout& layout) {
  const Extents extents = frames.extents();
  const auto particles = static_cast<std::size_t>(extents.particles);
  require(
      have_size(particles, rows.id, rows.kind, rows.move) && have_size(2 * particles, rows.site),
      context, "particles and frames do not go together");
  require(have_size(static_cast<std::size_t>(extents.pushes), rows.pushed, rows.pusher,
                    rows.push_source, rows.push_direction),
          context, "pushes and frames do not go together");
  require(
      have_size(layout.velocities ? 2 * particles : 0, rows.velocity) && all_finite(rows.velocity),
      context, "velocities and particles do not go together");
  require((rows.spin.empty() || have_size(layout.velocities ? particles : 0, rows.spin)) &&
              all_finite(rows.spin),
          context, "spins and particles do not go together");
  require(all_below(rows.kind, fixed.kinds.size()), context, "a kind that the scene does not have");
  require(all_below(rows.move, grains::kRest + 1), context, "a move that is none");
  require(all_below(rows.push_direction, lattice::kDirectionCount), context,
          "a number that is no direction");
  require(all_inside(fixed.lattice, rows.site), context, "a particle outside the box");
  for (std::size_t frame = 0; frame < frames.step.size(); ++frame) {
    require_in_frame(ascend(rows.id, frames.particles.rows_of(frame), frames.entered[frame]),
                     context, frames.step[frame], "ids of particles out of order or out of range");
  }
  check_wall_rows(context, frames, rows, fixed.walls);
  if (layout.contacts) {
    check_contact_rows(context, frames, rows, fixed);
  }
}

void check_state(const PartContext& context, const grains::State& state) {
  const auto& pushes = state.pushes;
  require_in_frame(
      are_in_order(pushes) && std::all_of(pushes.begin(), pushes.end(),
                                          [&](const auto& push) { return is_push(state, push); }),
      context, state.step, "a push that cannot be");
  try {
    const grains::Occupancy occupancy(state);
    require_in_frame(std::all_of(pushes.begin(), pushes.end(),
                                 [&](const auto& push) { return overlap(state, occupancy, push); }),
                     context, state.step, "a push without an overlap");
  } catch (const std::logic_error& error) {  // of Occupancy
    refuse_frame(context, state.step, error.what());
  }
}

}  // namespace clca::store
