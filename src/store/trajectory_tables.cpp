#include "store/trajectory_tables.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "clca/scene/units.hpp"
#include "clca/store/datasets.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "clca/text/message.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

namespace {

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
