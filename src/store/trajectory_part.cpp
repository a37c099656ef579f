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
  if (const auto units = scene::unit_conversion(scene)) {
    text += fmt::format(" of {} {}", units->time_step, units->time_unit);
  }
  return text;
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

std::string name_of(RowKind row_kind) {
  return kRowKindNames.at(static_cast<std::size_t>(row_kind));
}

std::string shape_text(const TrajectoryDataset& column) {
  std::string text = name_of(column.row_kind);
  for (std::size_t i = 0; i < column.row_shape.size(); ++i) {
    text += column.row_kind == RowKind::frames && i == 0
                ? " x walls"
                : fmt::format(" x {}", column.row_shape[i]);
  }
  return text;
}

}  // namespace

void refuse_part(const std::filesystem::path& path, std::string_view reason) {
  throw StoreError(fmt::format("cannot read {}: {}", path.string(), reason));
}

OptionalDatasets optional_datasets(const scene::Scene& scene) {
  const auto& trajectory = scene.output.trajectory;
  return {.wall_count = scene.walls.size(),
          .has_velocities = scene.model == scene::Model::contact,
          .has_contacts = trajectory && trajectory->has_contacts};
}

RowCounts& operator+=(RowCounts& row_counts, const RowCounts& more) {
  row_counts[RowKind::frames] += more[RowKind::frames];
  for (const RowKind row_kind : kKindsInFrames) {
    row_counts[row_kind] += more[row_kind];
  }
  return row_counts;
}

void RowRanges::end_frame(std::uint64_t before, std::size_t rows) {
  const std::uint64_t start = first_rows.empty() ? before : first_rows.back() + row_counts.back();
  first_rows.push_back(start);
  row_counts.push_back(static_cast<std::uint32_t>(before + rows - start));
}

RowSpan RowRanges::rows_of(std::size_t frame) const {
  const auto start = static_cast<std::size_t>(first_rows[frame] - first_rows.front());
  return {start, start + row_counts[frame]};
}

RowCounts PartFrames::total_rows() const {
  RowCounts row_counts;
  row_counts[RowKind::frames] = step.size();
  for (const RowKind row_kind : kKindsInFrames) {
    row_counts[row_kind] = sum_of(row_ranges[row_kind].row_counts);
  }
  return row_counts;
}

void TrajectoryPart::add_frame(const grains::State& state, std::size_t stage,
                               std::size_t first_origin, const RowCounts& before,
                               const ContactFrame& contact) {
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    rows.id.push_back(static_cast<std::uint32_t>(id));
    add_site_row(rows.site, particle.site());
    rows.kind.push_back(particle.kind);
    rows.last_move.push_back(particle.previous);
    rows.species.push_back(state.kinds[particle.kind].species);
    add_point_row(rows.position, grains::centre_in_box(state, particle));
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
    rows.contact_upper.push_back(force.upper);
    rows.contact_other.push_back(force.other);
    add_point_row(rows.contact_point, force.point);
    add_point_row(rows.contact_normal, force.normal);
    add_point_row(rows.contact_branch, force.branch);
    add_point_row(rows.contact_force, {force.normal_force, force.shear_force});
  }
  for (const grains::Wall& wall : state.walls) {
    rows.wall_present.push_back(wall.present ? 1 : 0);
    rows.wall_offset.push_back(wall.travel.offset);
    add_point_row(rows.wall_position, lattice::position(wall.shift()));
  }
  frames.step.push_back(state.step);
  frames.stage.push_back(static_cast<std::uint32_t>(stage));
  frames.entered_particles.push_back(static_cast<std::uint32_t>(state.particles.size()));
  for (const auto& [row_kind, count] : {std::pair(RowKind::particles, rows.id.size()),
                                        {RowKind::origins, origins.id.size()},
                                        {RowKind::pushes, rows.pushed.size()},
                                        {RowKind::contacts, rows.contact_upper.size()}}) {
    frames.row_ranges[row_kind].end_frame(before[row_kind], count);
  }
}

std::vector<TrajectoryDataset> TrajectoryPart::datasets(const OptionalDatasets& layout) {
  std::vector<TrajectoryDataset> all;
  const auto columns = [&all](RowKind row_kind, DatasetUse use) {
    return [&all, row_kind, use](const std::string& path, Hdf5Dataset::Values values,
                                 const std::string& text, const char* unit = "",
                                 const std::vector<std::size_t>& row = {},
                                 bool may_be_missing = false) {
      const std::size_t width =
          std::accumulate(row.begin(), row.end(), std::size_t{1}, std::multiplies<>());
      all.push_back({{path, values, width, {unit, text}, may_be_missing}, row_kind, use, row});
    };
  };
  const auto of_frames = columns(RowKind::frames, DatasetUse::index);
  of_frames("frames/step", &frames.step, "of the whole run", "steps");
  of_frames("frames/stage", &frames.stage, "which of `scene/stages`, from 0");
  of_frames("frames/entered", &frames.entered_particles,
            "particles that had entered; ids are below this");
  for (const auto& [row_kind, first] : {std::pair(RowKind::particles, "first"),
                                        {RowKind::origins, "first_origin"},
                                        {RowKind::pushes, "first_push"},
                                        {RowKind::contacts, "first_contact"}}) {
    const std::string of = name_of(row_kind);
    if (row_kind != RowKind::contacts || layout.has_contacts) {
      of_frames("frames/" + std::string(first), &frames.row_ranges[row_kind].first_rows,
                "the first row of the frame in `" + of + "`");
      of_frames("frames/" + of, &frames.row_ranges[row_kind].row_counts,
                "rows of the frame in `" + of + "`");
    }
  }

  const auto of_origins = columns(RowKind::origins, DatasetUse::index);
  of_origins("origins/id", &origins.id,
             "of the particle; all in the first frame of a stage, later the new ones");
  of_origins("origins/site", &origins.site,
             "column and row where it was when the stage began or it entered", "sites", {2});

  const auto of_particles = columns(RowKind::particles, DatasetUse::rows);
  of_particles("particles/id", &rows.id, "for life; ascending in a frame, without those gone");
  of_particles("particles/site", &rows.site,
               "column and row of the reference site; the column, as nothing else, counts on "
               "across a periodic boundary",
               "sites", {2});
  of_particles("particles/kind", &rows.kind, "which of `scene/kinds`: species and orientation");
  of_particles("particles/move", &rows.last_move,
               "the last move: 0 to 5 clockwise from up, 6 none");
  if (layout.has_velocities) {
    of_particles("particles/velocity", &rows.velocity, "x, y; of the contact model",
                 "spacings/step", {2});
    of_particles("particles/spin", &rows.spin,
                 "angular velocity, anticlockwise, times the radius of a disc of the same area; "
                 "of the contact model",
                 "spacings/step", {}, true);
  }

  const auto of_pushes = columns(RowKind::pushes, DatasetUse::rows);
  of_pushes("pushes/pushed", &rows.pushed, "id of a particle that was pushed");
  of_pushes("pushes/pusher", &rows.pusher,
            "by whom: a particle, or -2 for the first wall, -3 for the second ...");
  of_pushes("pushes/source", &rows.push_source, "the wall where the push began");
  of_pushes("pushes/direction", &rows.push_direction, "0 to 5 clockwise from up");

  if (layout.wall_count > 0) {
    const auto of_walls = columns(RowKind::frames, DatasetUse::rows);
    of_walls("walls/present", &rows.wall_present, "1 where the wall is there", "",
             {layout.wall_count});
    of_walls("walls/offset", &rows.wall_offset, "from home along its motion", "sites",
             {layout.wall_count});
  }

  if (layout.has_contacts) {
    const auto of_contacts = columns(RowKind::contacts, DatasetUse::rows);
    of_contacts("contacts/upper", &rows.contact_upper, "id of a particle");
    of_contacts("contacts/other", &rows.contact_other,
                "what it touches: a particle, -2 for the first wall, -3 for the second ..., or "
                "-2³¹, -2³¹+1, -2³¹+2, -2³¹+3 for `box.floor`, `box.top`, `box.left`, `box.right`");
    of_contacts("contacts/place", &rows.contact_point, "x, y of the contact, in the box",
                "spacings", {2});
    of_contacts("contacts/normal", &rows.contact_normal, "x, y: unit vector to the upper particle",
                "", {2});
    of_contacts("contacts/branch", &rows.contact_branch,
                "x, y from the other centre, or from the point of contact with what is no "
                "particle, to the upper centre",
                "spacings", {2});
    of_contacts("contacts/force", &rows.contact_force,
                "on the upper particle: along the normal, and along the normal turned "
                "anticlockwise",
                "weights of a grain of mean mass", {2});
  }

  const auto more_of_particles = columns(RowKind::particles, DatasetUse::derived);
  more_of_particles("particles/species", &rows.species, "which of `scene/species`");
  more_of_particles("particles/position", &rows.position, "x, y of the centre of mass, in the box",
                    "spacings", {2});
  if (layout.wall_count > 0) {
    columns(RowKind::frames, DatasetUse::derived)("walls/position", &rows.wall_position,
                                                  "x, y from home", "spacings",
                                                  {layout.wall_count, 2});
  }
  return all;
}

void SiteSets::begin_set() {
  first_sites.push_back(sites.size() / 2);
  site_counts.push_back(0);
}

void SiteSets::add_site(int one, int other) {
  sites.push_back(one);
  sites.push_back(other);
  ++site_counts.back();
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
    kind_sites.begin_set();
    for (const lattice::Axial site : kind.shape.sites()) {
      kind_sites.add_site(site.x, site.q);
    }
  }
  for (const grains::Wall& wall : state.walls) {
    wall_sites.begin_set();
    for (const lattice::Site site : wall.sites) {
      wall_sites.add_site(site.column, site.row);
    }
  }
}

std::vector<Hdf5Dataset> SceneTables::datasets() {
  std::vector<Hdf5Dataset> all;
  const auto add = [&all](const char* path, auto* values, Meaning meaning, std::size_t columns = 1,
                          bool may_be_missing = false) {
    all.push_back({std::string("scene/") + path, values, columns, meaning, may_be_missing});
  };
  add("seed", &seed, {"", "of the run"});
  add("lattice", &lattice, {"", "columns, rows, 1 if periodic"});
  add("species", &species, {"", "names"});
  add("stages", &stages, {"", "names"});
  add("kinds/species", &kind_species,
      {"", "of each kind, a species in one orientation, which of `scene/species`"});
  add("kinds/first", &kind_sites.first_sites,
      {"", "of each kind the first row in `scene/kinds/sites`"});
  add("kinds/size", &kind_sites.site_counts, {"sites", "of each kind"});
  add("kinds/sites", &kind_sites.sites, {"sites", "axial x and q from the reference site"}, 2);
  add("walls/name", &walls, {"", "of each wall"});
  add("walls/first", &wall_sites.first_sites,
      {"", "of each wall the first row in `scene/walls/sites`"});
  add("walls/size", &wall_sites.site_counts, {"sites", "of each wall"});
  add("walls/sites", &wall_sites.sites, {"sites", "column and row at home"}, 2);
  // For other programs: require_same() does not compare what follows.
  add("kinds/centre", &kind_centre,
      {"spacings", "of each kind x, y of the centre of mass from its site"}, 2, true);
  add("name", &name, {"", "of the scene"}, 1, true);
  add("units", &units, {"", "of all that is in the file, in words"}, 1, true);
  return all;
}

void SceneTables::require_same(const SceneTables& read, const std::filesystem::path& path) const {
  const auto require = [&path](bool same, const char* other) {
    if (!same) {
      refuse_part(path, fmt::format("of another scene: {}", other));
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
  const auto add = [&list](const Hdf5Dataset& dataset) {
    std::visit(
        [&]<class T>(T* values) {
          if constexpr (!std::same_as<T, std::string>) {
            list.push_back({dataset.path, dataset.numbers_per_row, std::move(*values)});
          }
        },
        dataset.values);
  };
  SceneTables tables(scene, state);
  std::ranges::for_each(tables.datasets(), add);
  TrajectoryPart part;
  part.add_frame(state, stage, 0, {}, contact);
  std::ranges::for_each(part.datasets({.wall_count = state.walls.size(),
                                       .has_velocities = !contact.velocities.empty(),
                                       .has_contacts = true}),
                        add);
  return list;
}

std::string datasets_markdown_table() {
  std::string table = "| dataset | rows | type | unit | what |\n|---|---|---|---|---|\n";
  const auto add = [&table](const Hdf5Dataset& dataset, const std::string& rows) {
    const std::string type = std::visit(
        []<class T>(const T*) { return type_name<typename T::value_type>(); }, dataset.values);
    const auto& [unit, text] = dataset.meaning;
    table += fmt::format("| `{}` | {} | {} | {} | {} |\n", dataset.path, rows, type, unit, text);
  };
  TrajectoryPart none;
  for (const TrajectoryDataset& column :
       none.datasets({.wall_count = 1, .has_velocities = true, .has_contacts = true})) {
    add(column, shape_text(column));
  }
  SceneTables tables;
  for (const Hdf5Dataset& dataset : tables.datasets()) {
    add(dataset, dataset.numbers_per_row == 1 ? "" : fmt::format("x {}", dataset.numbers_per_row));
  }
  return table;
}

}  // namespace clca::store
