// Upper estimates of the memory of a scene.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "clca/automaton/automaton.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/grains/model.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

// Only a part of a deposited packing moves at a time, even where all walls go at once.
constexpr double kAwakeOfDeposited = 1.0 / 8;
// A site of a kind: in its shape, and from the reference site in columns of both parities.
constexpr double kKindSiteBytes = sizeof(lattice::Axial) + 2 * sizeof(lattice::IndexOffset);

/// Sites of the swept region in the rectangle, from above.
double max_sites(const lattice::SweptRegion& swept_region, const lattice::Rectangle& rectangle) {
  const auto share = [](double low, double high, double first, double end) {
    return std::clamp(high, first, end) - std::clamp(low, first, end);
  };
  const double columns =
      share(rectangle.left / lattice::kColumnPitch - 1, rectangle.right / lattice::kColumnPitch + 1,
            swept_region.first_column(), swept_region.end_column());
  const lattice::RowRange rows = swept_region.enclosing_rows();
  return columns * share(rectangle.bottom - 1, rectangle.top + 1, rows.first_row, rows.end_row);
}

/// Particles of a fill, at most. The proportions of a mixture are kept, but for chance.
double particles_in(const Scene& scene, const Fill& fill) {
  const auto mixture = mixture_of(fill);
  if (!mixture) {
    return std::accumulate(fill.species_counts.begin(), fill.species_counts.end(), 0.0);
  }
  double least = std::numeric_limits<double>::infinity();  // sites of a particle, in the mean
  for (const auto& weights : mixture->part_weights) {
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

/// Particles of all fills, or of those of one method, at most.
double filled_particles(const Scene& scene, std::optional<FillMethod> method = {}) {
  double sum = 0;
  for (const Stage& stage : scene.stages) {
    if (stage.fill && stage.fill->method == method.value_or(stage.fill->method)) {
      sum += particles_in(scene, *stage.fill);
    }
  }
  return sum;
}

/// Most particles that a source can emit while it is open.
double emitted_particles(const Scene& scene, std::size_t source) {
  double steps = 0;
  for (const Stage& stage : scene.stages) {
    if (std::ranges::find(stage.open_sources, source) != stage.open_sources.end()) {
      steps += static_cast<double>(fixed_steps(stage.until).value_or(stage.max_steps));
    }
  }
  const double most = std::ceil(steps * scene.sources[source].particles_per_step);
  const auto& count = scene.sources[source].max_particles;
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

/// From above: for each part the area, or the rectangle around it if that is less. Each step of a
/// motion brings in those along two edges of the box at the most.
double wall_sites_at_most(const lattice::Lattice& lattice, const Wall& wall) {
  const double columns = lattice.columns();
  const double rows = lattice.rows();
  const grains::OffsetRange range =
      wall.motion ? grains::offset_range(*wall.motion) : grains::OffsetRange{};
  const lattice::SweptRegion region = swept_region_of(lattice, wall);
  const double all = columns * rows + (range.high - range.low) * (columns + rows + 1);
  double sum = 0;
  for (const WallPart& part : wall.parts) {
    const auto max_of = [&](const auto& form) {
      return std::min(
          {all, area(form) / lattice::kColumnPitch, max_sites(region, bounding_rectangle(form))});
    };
    sum += std::visit(max_of, part);
  }
  return sum;
}

/// Lists of sites that the largest fill tries: for one species at a time, or for a mixture.
double fill_bytes(const Scene& scene, const lattice::Lattice& lattice) {
  const lattice::SweptRegion box(lattice);
  double most = 0;
  for (const Stage& stage : scene.stages) {
    const bool tries = stage.fill && stage.fill->method == FillMethod::random;
    double all = 0;
    for (std::size_t i = 0; tries && i < scene.species.size(); ++i) {
      const auto kinds = static_cast<double>(scene.species[i].orientations.size());
      const double sites = places_species(*stage.fill, i) ? max_sites(box, stage.fill->region) : 0;
      const double bytes = grains::fill_trial_bytes(sites, kinds);
      all = stage.fill->species_counts.empty() ? all + bytes : std::max(all, bytes);
    }
    most = std::max(most, all);
  }
  return most;
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

// Of each particle of a gas.
constexpr double kMotionBytes = 6 * sizeof(double);
constexpr double kWorkspaceBytes = 8;
constexpr double kSortEntryBytes = 16;  // speed and number
// Kept for each gas of the ensemble until the end, and as the text of a table.
constexpr double kRowBytes = 256;
constexpr double kRowTextBytes = 512;
constexpr double kBinBytes = 16;
constexpr double kBinTextBytes = 128;

/// Rows and bins that all gases keep until the end, and the text of their tables.
double table_bytes(const BoltzmannScene& scene) {
  const double rows = scene.end_time / scene.series_interval + 2;
  const auto* uniform = std::get_if<UniformBins>(&scene.bins);
  const double bins = uniform != nullptr ? std::ceil(uniform->last_bin_start / uniform->width) + 1
                                         : std::get<QuantileBins>(scene.bins).count;
  const double shares = static_cast<double>(scene.histogram_times.size()) * bins;
  const auto gases = static_cast<double>(scene.ensemble_size);
  return static_cast<double>(scene.restitutions.size()) *
         ((kRowBytes * gases + kRowTextBytes) * rows +
          (kBinBytes * gases + kBinTextBytes) * shares);
}

/// Copies while a checkpoint is written: columns, the file, and the bytes that go to the disk.
constexpr double kSavedCopies = 3;

}  // namespace

ModelSize model_size(const Scene& scene) {
  const lattice::Lattice lattice = lattice_of(scene.box);
  double particles =
      filled_particles(scene) +
      (scene.initial_state ? static_cast<double>(scene.initial_state->particles) : 0);
  for (std::size_t source = 0; source < scene.sources.size(); ++source) {
    particles += emitted_particles(scene, source);
  }
  if (scene.outlets.empty()) {  // all of them have to find room
    particles = std::min(particles, static_cast<double>(lattice.columns()) * lattice.rows());
  }
  const double deposited = std::min(particles, filled_particles(scene, FillMethod::deposition));
  const double awake = particles - (1 - kAwakeOfDeposited) * deposited;
  const auto index_count = static_cast<double>(lattice.index_count());
  const double model =
      grains::OccupancyTable::bytes_for(index_count, walls_may_overlap(scene)) +
      grains::kParticleBytes * particles +
      (scene.model == Model::contact ? contact::step_bytes(particles)
                                     : automaton::step_bytes(index_count, particles, awake));
  // A stage that has other rules has a second model beside the first.
  const bool changes_rules = std::ranges::any_of(scene.stages, [](const Stage& stage) {
    return stage.automaton_rules || stage.contact_parameters;
  });
  double bytes = model * (changes_rules ? 2 : 1) + fill_bytes(scene, lattice) + kind_bytes(scene) +
                 source_bytes(scene, lattice);
  for (const Wall& wall : scene.walls) {
    bytes += sizeof(lattice::Site) * wall_sites_at_most(lattice, wall);
  }
  return {.columns = lattice.columns(),
          .rows = lattice.rows(),
          .max_particles = static_cast<std::uint64_t>(std::min(particles, 1e18)),
          .memory_bytes = bytes};
}

double retained_gas_bytes(const BoltzmannScene& scene) {
  constexpr double kMaxBytes = 1024.0 * 1024 * 1024;
  const double bytes = kMotionBytes * static_cast<double>(scene.particles) *
                       static_cast<double>(scene.ensemble_size) *
                       static_cast<double>(scene.restitutions.size());
  return scene.checkpoint && bytes <= kMaxBytes ? bytes : 0;
}

double gas_run_bytes(const BoltzmannScene& scene, int threads) {
  const auto members = static_cast<double>(
      std::min(scene.ensemble_size, static_cast<std::uint64_t>(std::max(1, threads))));
  // Two copies: at first the sample of a gas; with the literal scheme the state before a step.
  double per_particle = 2 * kMotionBytes + kWorkspaceBytes;
  if (scene.quasi_random && std::holds_alternative<boltzmann::OgawaKato>(scene.scheme)) {
    per_particle += kMotionBytes + kSortEntryBytes;  // it is sorted
  }
  const double saved = kSavedCopies * kMotionBytes;
  // A checkpoint is written while the gases go on; a stopped run needs no second copy.
  per_particle =
      scene.checkpoint ? per_particle + saved : std::max(per_particle, saved + kMotionBytes);
  return members * per_particle * static_cast<double>(scene.particles) +
         (1 + kSavedCopies) * retained_gas_bytes(scene) + table_bytes(scene);
}

}  // namespace clca::scene
