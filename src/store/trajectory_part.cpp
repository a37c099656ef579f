#include "store/trajectory_part.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace clca::store {

namespace {

std::uint64_t sum_of(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

void add_site_row(std::vector<std::int32_t>& rows, lattice::Site site) {
  rows.insert(rows.end(), {site.column, site.row});
}

void add_point_row(std::vector<double>& rows, const Eigen::Vector2d& point) {
  rows.insert(rows.end(), {point.x(), point.y()});
}

}  // namespace

Layout layout_of(const scene::Scene& scene) {
  const auto& trajectory = scene.output.trajectory;
  return {.walls = scene.walls.size(),
          .velocities = scene.model == scene::Model::contact,
          .contacts = trajectory && trajectory->contacts};
}

Extents& Extents::operator+=(const Extents& other) {
  std::transform(rows_.begin(), rows_.end(), other.rows_.begin(), rows_.begin(), std::plus());
  return *this;
}

std::size_t Column::width() const {
  return std::accumulate(row.begin(), row.end(), std::size_t{1}, std::multiplies<>());
}

void RowRanges::end_frame(std::uint64_t before, std::size_t rows) {
  const std::uint64_t start = first.empty() ? before : first.back() + count.back();
  first.push_back(start);
  count.push_back(static_cast<std::uint32_t>(before + rows - start));
}

RowSpan RowRanges::rows_of(std::size_t frame) const {
  const auto start = static_cast<std::size_t>(first[frame] - first.front());
  return {start, start + count[frame]};
}

Extents PartFrames::extents() const {
  Extents extents;
  extents[Axis::frames] = step.size();
  extents[Axis::particles] = sum_of(particles.count);
  extents[Axis::origins] = sum_of(origins.count);
  extents[Axis::pushes] = sum_of(pushes.count);
  extents[Axis::contacts] = sum_of(contacts.count);
  return extents;
}

void TrajectoryPart::add(const grains::State& state, std::size_t stage, std::size_t first_origin,
                         const Extents& before, const ContactFrame& contact) {
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    rows.id.push_back(static_cast<std::uint32_t>(id));
    add_site_row(rows.site, particle.site());
    rows.kind.push_back(particle.kind);
    rows.move.push_back(particle.previous);
    derived.species.push_back(state.kinds[particle.kind].species);
    add_point_row(derived.position, grains::centre_in_box(state, particle));
    if (!contact.velocities.empty()) {
      add_point_row(rows.velocity, contact.velocities[id]);
      rows.spin.push_back(contact.spins[id]);
    }
    if (id >= first_origin) {
      origins.id.push_back(static_cast<std::uint32_t>(id));
      add_site_row(origins.site, state.origins[id]);
    }
  }
  for (const grains::Push& push : state.pushes) {
    rows.pushed.push_back(push.pushed);
    rows.pusher.push_back(push.pusher);
    rows.push_source.push_back(push.source);
    rows.push_direction.push_back(static_cast<std::uint8_t>(push.direction));
  }
  for (const contact::Force& force : contact.forces) {
    rows.upper.push_back(force.upper);
    rows.other.push_back(force.other);
    add_point_row(rows.point, force.point);
    add_point_row(rows.normal, force.normal);
    add_point_row(rows.branch, force.branch);
    add_point_row(rows.force, {force.along_normal, force.along_shear});
  }
  for (const grains::Wall& wall : state.walls) {
    rows.wall_present.push_back(wall.present ? 1 : 0);
    rows.wall_offset.push_back(wall.travel.offset);
    add_point_row(derived.wall_position, lattice::position(wall.shift()));
  }
  frames.step.push_back(state.step);
  frames.stage.push_back(static_cast<std::uint32_t>(stage));
  frames.entered.push_back(static_cast<std::uint32_t>(state.particles.size()));
  frames.particles.end_frame(before[Axis::particles], rows.id.size());
  frames.origins.end_frame(before[Axis::origins], origins.id.size());
  frames.pushes.end_frame(before[Axis::pushes], rows.pushed.size());
  frames.contacts.end_frame(before[Axis::contacts], rows.upper.size());
}

std::size_t TrajectoryPart::bytes() const {
  std::size_t sum = 0;
  // All possible datasets; unused ones are empty.
  for_each_column(
      *this, {.walls = 1, .velocities = true, .contacts = true},
      [&sum](const Column&, const auto& values) { sum += values.size() * sizeof(values.front()); });
  return sum;
}

void add_datasets(TrajectoryPart& part, const Layout& layout, Use use,
                  std::vector<Hdf5Dataset>& datasets) {
  for_each_column(part, layout, [&](const Column& column, auto& values) {
    if (column.use == use) {
      datasets.push_back({.path = column.path,
                          .values = &values,
                          .columns = column.width(),
                          .may_be_missing = column.may_be_missing});
    }
  });
}

}  // namespace clca::store
