#include "store/trajectory_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>

#include "clca/scene/units.hpp"
#include "clca/store/file.hpp"
#include "clca/text/message.hpp"

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

std::string units_text(const scene::Scene& scene) {
  std::string text = "lengths in lattice spacings, heights from the lowest sites, time in steps";
  if (const auto units = scene::conversion(scene)) {
    text += fmt::format(" of {} {}", units->time_step, units->time_unit);
  }
  return text;
}

constexpr Meaning kName = {"", "of the scene"};
constexpr Meaning kUnits = {"", "of all that is in the file, in words"};
constexpr Meaning kCentre = {"spacings", "of each kind x, y of the centre of mass from its site"};

/// Calls visit(path, list, columns, meaning) for each dataset that identifies the scene.
template <class Tables, class Visit>
void for_each_table(Tables& tables, Visit visit) {
  visit("scene/seed", tables.seed, 1, Meaning{"", "of the run"});
  visit("scene/lattice", tables.lattice, 1, Meaning{"", "columns, rows, 1 if periodic"});
  visit("scene/species", tables.species, 1, Meaning{"", "names"});
  visit("scene/stages", tables.stages, 1, Meaning{"", "names"});
  visit("scene/kinds/species", tables.kind_species, 1,
        Meaning{"", "of each kind, a species in one orientation, which of `scene/species`"});
  visit("scene/kinds/first", tables.kind_sites.first, 1,
        Meaning{"", "of each kind the first row in `scene/kinds/sites`"});
  visit("scene/kinds/size", tables.kind_sites.size, 1, Meaning{"sites", "of each kind"});
  visit("scene/kinds/sites", tables.kind_sites.sites, 2,
        Meaning{"sites", "axial x and q from the reference site"});
  visit("scene/walls/name", tables.walls, 1, Meaning{"", "of each wall"});
  visit("scene/walls/first", tables.wall_sites.first, 1,
        Meaning{"", "of each wall the first row in `scene/walls/sites`"});
  visit("scene/walls/size", tables.wall_sites.size, 1, Meaning{"sites", "of each wall"});
  visit("scene/walls/sites", tables.wall_sites.sites, 2,
        Meaning{"sites", "column and row at home"});
}

/// `u8` to `f64`, or `text`.
template <class Item>
std::string type_name() {
  if constexpr (!Number<Item>) {
    return "text";
  } else {
    const char* kind = std::is_floating_point_v<Item> ? "f" : std::is_signed_v<Item> ? "i" : "u";
    return fmt::format("{}{}", kind, 8 * sizeof(Item));
  }
}

std::string shape_text(const Column& column) {
  std::string text = kAxisNames.at(static_cast<std::size_t>(column.axis));
  for (std::size_t i = 0; i < column.row.size(); ++i) {
    text +=
        column.axis == Axis::frames && i == 0 ? " x walls" : fmt::format(" x {}", column.row[i]);
  }
  return text;
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

void SiteSets::begin() {
  first.push_back(sites.size() / 2);
  size.push_back(0);
}

void SiteSets::add(int one, int other) {
  sites.push_back(one);
  sites.push_back(other);
  ++size.back();
}

SceneTables::SceneTables(const scene::Scene& scene, const grains::State& state)
    : name(scene.name),
      units(units_text(scene)),
      seed({state.seed}),
      lattice({static_cast<std::uint32_t>(state.lattice.columns()),
               static_cast<std::uint32_t>(state.lattice.rows()),
               state.lattice.periodic() ? 1U : 0U}),
      species(text::names_of<std::string>(scene.species)),
      stages(text::names_of<std::string>(scene.stages)),
      walls(text::names_of<std::string>(scene.walls)) {
  for (const grains::Kind& kind : state.kinds) {
    kind_species.push_back(kind.species);
    const Eigen::Vector2d centre = kind.shape.centroid();
    kind_centre.insert(kind_centre.end(), {centre.x(), centre.y()});
    kind_sites.begin();
    for (const lattice::Axial site : kind.shape.sites()) {
      kind_sites.add(site.x, site.q);
    }
  }
  for (const grains::Wall& wall : state.walls) {
    wall_sites.begin();
    for (const lattice::Site site : wall.sites) {
      wall_sites.add(site.column, site.row);
    }
  }
}

void SceneTables::write(const Hdf5Writer& file) const {
  file.add("scene/name", name, 1, kName);
  file.add("scene/units", units, 1, kUnits);
  file.add("scene/kinds/centre", kind_centre, 2, kCentre);
  for_each_table(*this,
                 [&file](const char* path, const auto& list, std::size_t columns,
                         const Meaning& meaning) { file.add(path, list, columns, meaning); });
}

std::vector<Hdf5Dataset> SceneTables::datasets() {
  std::vector<Hdf5Dataset> list;
  for_each_table(*this,
                 [&list](const char* path, auto& values, std::size_t columns, const Meaning&) {
                   list.push_back({.path = path, .values = &values, .columns = columns});
                 });
  return list;
}

void SceneTables::require_same(const SceneTables& read, const std::filesystem::path& path) const {
  const auto require = [&path](bool same, const char* other) {
    if (!same) {
      throw StoreError(fmt::format("cannot read {}: of another scene: {}", path.string(), other));
    }
  };
  require(lattice == read.lattice, "another lattice");
  require(seed == read.seed, "another seed");
  require(
      species == read.species && kind_species == read.kind_species && kind_sites == read.kind_sites,
      "other species");
  require(walls == read.walls && wall_sites == read.wall_sites, "other walls");
  require(stages == read.stages, "other stages");
}

std::vector<Dataset> datasets(const scene::Scene& scene, const grains::State& state,
                              std::size_t stage, const ContactFrame& contact) {
  std::vector<Dataset> list;
  SceneTables tables(scene, state);
  for_each_table(tables,
                 [&list](const char* path, auto& values, std::size_t columns, const Meaning&) {
                   list.push_back({path, columns, std::move(values)});
                 });
  list.push_back({"scene/kinds/centre", 2, std::move(tables.kind_centre)});
  TrajectoryPart part;
  part.add(state, stage, 0, {}, contact);
  for_each_column(
      part,
      {.walls = state.walls.size(), .velocities = !contact.velocities.empty(), .contacts = true},
      [&list](const Column& column, auto& values) {
        list.push_back({column.path, column.width(), std::move(values)});
      });
  return list;
}

std::string datasets_table() {
  std::string table = "| dataset | rows | type | unit | what |\n|---|---|---|---|---|\n";
  const auto add = [&table](const char* path, const std::string& rows, std::string_view type,
                            const Meaning& meaning) {
    table +=
        fmt::format("| `{}` | {} | {} | {} | {} |\n", path, rows, type, meaning.unit, meaning.text);
  };
  const TrajectoryPart none;
  for_each_column(none, {.walls = 1, .velocities = true, .contacts = true},
                  [&]<class T>(const Column& column, const std::vector<T>&) {
                    add(column.path, shape_text(column), type_name<T>(), column.meaning);
                  });
  const SceneTables tables;
  for_each_table(tables, [&]<class T>(const char* path, const std::vector<T>&, std::size_t columns,
                                      const Meaning& meaning) {
    add(path, columns == 1 ? "" : fmt::format("x {}", columns), type_name<T>(), meaning);
  });
  add("scene/kinds/centre", "x 2", "f64", kCentre);
  add("scene/name", "", "text", kName);
  add("scene/units", "", "text", kUnits);
  return table;
}

}  // namespace clca::store
