// Upper estimates of the memory of a scene.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "clca/automaton/automaton.hpp"
#include "clca/contact/force.hpp"
#include "clca/scene/resolve.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "scene/geometry.hpp"
#include "scene/sections.hpp"
#include "scene/swept_sites.hpp"

namespace clca::scene {

namespace {

// With its number in the list of those awake, which doubles: at the beginning all are.
constexpr double kParticleBytes = sizeof(grains::Particle) + sizeof(lattice::Site) + 8;
// What a step notes of a particle that it looks at, in lists that double: where it wants to go, and
// its number in two lists.
constexpr double kAwakeBytes = 110;
// Of a packing that is deposited a part moves at a time: even where all walls go at once, the rest
// waits for it. All are looked at once, though.
constexpr double kAwakeOfDeposited = 1.0 / 8;
// Of the contact model: what is by grain, and for each of its two contacts, in lists that double,
// 32 in the state and twice 96 where they are put in order.
constexpr double kContactGrainBytes = 200 + 2 * 2 * (32 + 2 * 96);
constexpr double kTrialBytes = sizeof(lattice::Site) + 4;  // see fill_region
// A part of the trajectory as it is gathered (lists that double), in HDF5 and as a file, twice.
constexpr double kTrajectoryPartBytes = 6 * 0x1p24;
constexpr double kTrajectoryRowBytes = 6 * 45;
// Of the contact model: a velocity with a spin, and the contacts of a grain.
constexpr double kVelocityRowBytes = 6 * 24;
constexpr double kContactRowBytes = 6 * 4 * 72;
// Sums of forces over a window, of four contacts a grain: two blocks and their total, each sum with
// its entry in a map.
constexpr double kForceWindowBytes = 12.0 * (sizeof(contact::ForceSums::Sum) + 48);
// Of pictures with velocities, for each particle: its centre at the last picture, as it is copied
// and saved, and its displacement.
constexpr double kVelocityBytes = 3 * sizeof(std::optional<Eigen::Vector2d>) + 48;
// Of a part of a line: its points, and sums that double where a checkpoint is made of them.
constexpr double kLinePartBytes = 256 * 8 + 2 * 16 * 56;
// While there are lines: where each particle was at the last row, and its velocity.
constexpr double kObservedBytes = 2 * 24 + 24 + 16;
// Of the measure `mixing`: where each particle began and its path, and three pairs of neighbours,
// in a list that doubles.
constexpr double kMixingBytes = 12 + 64 + 2 * 3 * 12 + 28;
// A site of a kind: in its shape, and from the reference site in columns of both parities.
constexpr double kKindSiteBytes = sizeof(lattice::Axial) + 2 * sizeof(lattice::Offset);
// A sample of a picture: its colour on the canvas and as it is read, and what lies beneath, of the
// picture on its way, of three that wait, and of the walls.
constexpr double kSampleBytes = 2 * 4 + 5 * 2;

/// Sites of the swept region in the rectangle, from above.
double max_sites(const lattice::SweptRegion& swept_region, const lattice::Rectangle& rectangle) {
  const auto share = [](double low, double high, double first, double end) {
    return std::clamp(high, first, end) - std::clamp(low, first, end);
  };
  const double columns =
      share(rectangle.left / lattice::kColumnPitch - 1, rectangle.right / lattice::kColumnPitch + 1,
            swept_region.first_column(), swept_region.end_column());
  const lattice::RowRange rows = swept_region.all_rows();
  return columns * share(rectangle.bottom - 1, rectangle.top + 1, rows.first, rows.end);
}

/// Particles of a fill, at most. The proportions of a mixture are kept, but for chance.
double particles_in(const Scene& scene, const Fill& fill) {
  const auto mixture = mixture_of(fill);
  if (!mixture) {
    return std::accumulate(fill.counts.begin(), fill.counts.end(), 0.0);
  }
  double least = std::numeric_limits<double>::infinity();  // sites of a particle, in the mean
  for (const auto& weights : mixture->parts) {
    double sites = 0;
    double all = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      sites += static_cast<double>(scene.species[i].shape.size()) * weights[i];
      all += weights[i];
    }
    least = std::min(least, sites / all);
  }
  return std::ceil(max_sites(lattice::SweptRegion(lattice_of(scene.box)), fill.region) / least);
}

/// By any method, or by one.
double filled(const Scene& scene, std::optional<FillMethod> method = {}) {
  double sum = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.fill && stage.fill->method == method.value_or(stage.fill->method)) {
      sum += particles_in(scene, *stage.fill);
    }
  }
  return sum;
}

/// Most particles that a source can emit while it is open.
double emitted(const Scene& scene, std::size_t source) {
  double steps = 0;
  for (const Stage& stage : scene.stages) {
    if (std::find(stage.sources.begin(), stage.sources.end(), source) != stage.sources.end()) {
      steps += static_cast<double>(steps_of(stage.until).value_or(stage.max_steps));
    }
  }
  const double most = std::ceil(steps * scene.sources[source].rate);
  const auto& count = scene.sources[source].count;
  return count ? std::min(most, static_cast<double>(*count)) : most;
}

/// Area that holds the cells of all sites, those on the edge included.
double area(const lattice::Rectangle& box) {
  return (box.right - box.left + 4) * (box.top - box.bottom + 4);
}
double area(const lattice::Segment& line) {
  return ((line.to - line.from).norm() + line.thickness + 4) * (line.thickness + 4);
}
double area(const Disc& disc) {
  return std::numbers::pi * (disc.radius + 2) * (disc.radius + 2);
}
double area(const Ring& ring) {
  return std::numbers::pi * (2 * ring.radius + ring.thickness + 4) * (ring.thickness + 4);
}
double area(const Arc& arc) {
  return area(arc.ring);
}
double area(const lattice::Picture& picture) {
  return area(picture.box);
}

/// From above: by the area, or by the rectangle around it.
double part_sites(const lattice::SweptRegion& swept_region, const WallPart& part) {
  return std::visit(
      [&](const auto& form) {
        return std::min(area(form) / lattice::kColumnPitch, max_sites(swept_region, around(form)));
      },
      part);
}

/// Each step of a motion brings in those along two edges of the box at the most.
double wall_sites_at_most(const lattice::Lattice& lattice, const Wall& wall) {
  const double columns = lattice.columns();
  const double rows = lattice.rows();
  const grains::OffsetRange range =
      wall.motion ? grains::range_of(*wall.motion) : grains::OffsetRange{};
  const double all = columns * rows + (range.high - range.low) * (columns + rows + 1);
  double sum = 0;
  for (const WallPart& part : wall.parts) {
    sum += std::min(all, part_sites(swept_region_of(lattice, wall), part));
  }
  return sum;
}

/// The lists of sites that the largest fill tries: of one species at a time, or of all of a
/// mixture.
double fill_bytes(const Scene& scene, const lattice::Lattice& lattice) {
  const lattice::SweptRegion box(lattice);
  double most = 0;
  for (const Stage& stage : scene.stages) {
    const bool tries = stage.fill && stage.fill->method == FillMethod::random;
    double all = 0;
    for (std::size_t i = 0; tries && i < scene.species.size(); ++i) {
      const auto kinds = static_cast<double>(scene.species[i].orientations.size());
      const double sites = has_species(*stage.fill, i) ? max_sites(box, stage.fill->region) : 0;
      const double bytes = sites * (sizeof(lattice::Site) + kTrialBytes * kinds);
      all = stage.fill->counts.empty() ? all + bytes : std::max(all, bytes);
    }
    most = std::max(most, all);
  }
  return most;
}

double picture_bytes(const Output& output) {
  if (!output.frames) {
    return 0;
  }
  const Frames& frames = *output.frames;
  // Where the scene gives no size, about 1280 x 720; where it gives one side, the other is at most
  // four times as long.
  const double width = frames.width.value_or(frames.height ? 4 * *frames.height : 1280);
  const double height = frames.height.value_or(frames.width ? 2.5 * *frames.width : 720);
  return kSampleBytes * width * height * frames.supersampling * frames.supersampling;
}

/// A part is written once it is large enough: it has one frame too many at the most.
double trajectory_bytes(const Scene& scene, double particles) {
  const auto& trajectory = scene.output.trajectory;
  if (!trajectory) {
    return 0;
  }
  const double row = kTrajectoryRowBytes + (scene.model == Model::contact ? kVelocityRowBytes : 0) +
                     (trajectory->contacts ? kContactRowBytes : 0);
  return kTrajectoryPartBytes + row * particles;
}

double line_bytes(const Scene& scene, double particles) {
  double parts = 0;
  for (const Line& line : scene.lines) {
    parts += line.parts;
  }
  return kLinePartBytes * parts + (scene.lines.empty() ? 0 : kObservedBytes * particles);
}

bool measures(const Scene& scene, Measure measure) {
  return std::find(scene.measures.begin(), scene.measures.end(), measure) != scene.measures.end();
}

/// Windows of means of forces that may be there at a time: of tables, pictures and trajectory.
double force_windows(const Scene& scene) {
  const Output& output = scene.output;
  const bool in_tables = measures(scene, Measure::force) || measures(scene, Measure::weight_paths);
  const bool in_pictures = pictures_show_forces(scene);
  const bool in_frames = output.trajectory && output.trajectory->contacts;
  const bool at_end = in_tables || in_pictures || in_frames;
  return (at_end ? 1 : 0) + (in_pictures ? 1 : 0) + (in_frames ? 1 : 0);
}

/// The shapes of all kinds, and where the sites of each lie in memory.
double kind_bytes(const Scene& scene) {
  double sum = 0;
  for (const Species& species : scene.species) {
    const auto kinds = static_cast<double>(species.orientations.size());
    sum += static_cast<double>(species.shape.size()) *
           (sizeof(lattice::Axial) + kinds * kKindSiteBytes);
  }
  return sum;
}

double source_bytes(const Scene& scene, const lattice::Lattice& lattice) {
  double sum = 0;
  for (const Source& source : scene.sources) {
    if (const auto* region = std::get_if<lattice::Rectangle>(&source.position)) {
      sum += sizeof(lattice::Site) * max_sites(lattice::SweptRegion(lattice), *region);
    }
  }
  return sum;
}

/// Whether a stage has other rules, for which a second model is made beside the first.
bool changes_rules(const Scene& scene) {
  return std::any_of(scene.stages.begin(), scene.stages.end(),
                     [](const Stage& stage) { return stage.rules || stage.contact; });
}

}  // namespace

Size size_of(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  double particles =
      filled(scene) + (scene.begin ? static_cast<double>(scene.begin->particles) : 0);
  for (std::size_t source = 0; source < scene.sources.size(); ++source) {
    particles += emitted(scene, source);
  }
  if (scene.outlets.empty()) {  // all of them have to find room
    particles = std::min(particles, static_cast<double>(lattice.columns()) * lattice.rows());
  }
  const double deposited = std::min(particles, filled(scene, FillMethod::deposition));
  const double awake = particles - (1 - kAwakeOfDeposited) * deposited;
  const auto index_count = static_cast<double>(lattice.index_count());
  const bool overlaps = std::any_of(scene.walls.begin(), scene.walls.end(), [](const Wall& wall) {
    return wall.passive == grains::Passive::overlap;
  });
  double model_bytes = grains::OccupancyTable::bytes_for(index_count, overlaps) +
                       automaton::step_bytes(index_count) + kParticleBytes * particles +
                       kAwakeBytes * awake;
  if (scene.model == Model::contact) {
    model_bytes += kContactGrainBytes * particles;
  }
  double bytes = model_bytes * (changes_rules(scene) ? 2 : 1) + fill_bytes(scene, lattice) +
                 picture_bytes(scene.output) + trajectory_bytes(scene, particles) +
                 line_bytes(scene, particles);
  if (scene.model == Model::contact) {
    bytes += kForceWindowBytes * force_windows(scene) * particles;
  }
  if (measures(scene, Measure::mixing)) {
    bytes += kMixingBytes * particles;
  }
  if (pictures_compare_positions(scene)) {
    bytes += kVelocityBytes * particles;
  }
  for (const Wall& wall : scene.walls) {
    bytes += sizeof(lattice::Site) * wall_sites_at_most(lattice, wall);
  }
  bytes += kind_bytes(scene) + source_bytes(scene, lattice);
  return {.columns = lattice.columns(),
          .rows = lattice.rows(),
          .particles = static_cast<std::uint64_t>(std::min(particles, 1e18)),
          .bytes = bytes};
}

}  // namespace clca::scene
