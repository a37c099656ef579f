#include "store/trajectory_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/scene/units.hpp"
#include "clca/text/names_of.hpp"

namespace clca::store {

namespace {

std::string units_text(const scene::Scene& scene) {
  std::string text = "lengths in lattice spacings, heights from the lowest sites, time in steps";
  if (const auto units = scene::conversion(scene)) {
    text += fmt::format(" of {} {}", units->time_step, units->time_unit);
  }
  return text;
}

/// Calls visit(path, list, columns) for each dataset that identifies the scene.
template <class Tables, class Visit>
void for_each_table(Tables& tables, Visit visit) {
  visit("scene/seed", tables.seed, 1);
  visit("scene/lattice", tables.lattice, 1);
  visit("scene/species", tables.species, 1);
  visit("scene/stages", tables.stages, 1);
  visit("scene/kinds/species", tables.kind_species, 1);
  visit("scene/kinds/first", tables.kind_sites.first, 1);
  visit("scene/kinds/size", tables.kind_sites.size, 1);
  visit("scene/kinds/sites", tables.kind_sites.sites, 2);
  visit("scene/walls/name", tables.walls, 1);
  visit("scene/walls/first", tables.wall_sites.first, 1);
  visit("scene/walls/size", tables.wall_sites.size, 1);
  visit("scene/walls/sites", tables.wall_sites.sites, 2);
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
  file.add_text("scene/name", name);
  file.add_text("scene/units", units);
  file.add<double>("scene/kinds/centre", kind_centre, 2);
  for_each_table(
      *this, [&file]<class T>(const char* path, const std::vector<T>& list, std::size_t columns) {
        if constexpr (Number<T>) {
          file.add<T>(path, list, columns);
        } else {
          file.add_texts(path, list);
        }
      });
}

std::vector<Hdf5Dataset> SceneTables::datasets() {
  std::vector<Hdf5Dataset> list;
  for_each_table(*this, [&list](const char* path, auto& values, std::size_t columns) {
    list.push_back({.path = path, .values = &values, .columns = columns});
  });
  return list;
}

std::string SceneTables::difference(const SceneTables& other) const {
  if (lattice != other.lattice) {
    return "another lattice";
  }
  if (seed != other.seed) {
    return "another seed";
  }
  if (species != other.species || kind_species != other.kind_species ||
      kind_sites != other.kind_sites) {
    return "other species";
  }
  if (walls != other.walls || wall_sites != other.wall_sites) {
    return "other walls";
  }
  return stages != other.stages ? "other stages" : "";
}

}  // namespace clca::store
