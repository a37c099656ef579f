#include "store/trajectory_tables.hpp"

#include <algorithm>

namespace clca::store {

namespace {

constexpr const char* kUnits =
    "lengths in lattice spacings, heights from the lowest sites, time in steps";

template <class Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  std::transform(things.begin(), things.end(), std::back_inserter(names),
                 [](const auto& thing) { return thing.name; });
  return names;
}

template <Number T>
void add_list(SealedWriter& file, const std::string& path, const std::vector<T>& values,
              std::size_t width = 1) {
  file.add<T>(path, values, width);
}

void add_sets(SealedWriter& file, const std::string& group, const SiteSets& sets) {
  add_list(file, group + "/first", sets.first);
  add_list(file, group + "/size", sets.size);
  add_list(file, group + "/sites", sets.sites, 2);
}

SiteSets read_sets(const SealedReader& file, const std::string& group) {
  return {.first = file.read<std::uint64_t>(group + "/first"),
          .size = file.read<std::uint32_t>(group + "/size"),
          .sites = file.read<std::int32_t>(group + "/sites", 2)};
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

SceneTables::SceneTables(const scene::Scene& scene, const automaton::State& state)
    : name(scene.name),
      seed({state.seed}),
      lattice({static_cast<std::uint32_t>(state.lattice.columns()),
               static_cast<std::uint32_t>(state.lattice.rows()),
               state.lattice.periodic() ? 1U : 0U}),
      species(names_of(scene.species)),
      stages(names_of(scene.stages)),
      walls(names_of(scene.walls)) {
  for (const automaton::Kind& kind : state.kinds) {
    kind_species.push_back(kind.species);
    const Eigen::Vector2d centre = kind.shape.centroid();
    kind_centre.insert(kind_centre.end(), {centre.x(), centre.y()});
    kind_sites.begin();
    for (const lattice::Axial site : kind.shape.sites()) {
      kind_sites.add(site.x, site.q);
    }
  }
  for (const automaton::Wall& wall : state.walls) {
    wall_sites.begin();
    for (const lattice::Site site : wall.sites) {
      wall_sites.add(site.column, site.row);
    }
  }
}

SceneTables::SceneTables(const SealedReader& file)
    : name(file.read_text("scene/name")),
      seed(file.read<std::uint64_t>("scene/seed")),
      lattice(file.read<std::uint32_t>("scene/lattice")),
      species(file.read_texts("scene/species")),
      stages(file.read_texts("scene/stages")),
      kind_species(file.read<std::uint16_t>("scene/kinds/species")),
      kind_sites(read_sets(file, "scene/kinds")),
      walls(file.read_texts("scene/walls/name")),
      wall_sites(read_sets(file, "scene/walls")) {}

void SceneTables::write(SealedWriter& file) const {
  file.add_text("scene/name", name);
  file.add_text("scene/units", kUnits);
  add_list(file, "scene/seed", seed);
  add_list(file, "scene/lattice", lattice);
  file.add_texts("scene/species", species);
  file.add_texts("scene/stages", stages);
  add_list(file, "scene/kinds/species", kind_species);
  add_list(file, "scene/kinds/centre", kind_centre, 2);
  add_sets(file, "scene/kinds", kind_sites);
  file.add_texts("scene/walls/name", walls);
  add_sets(file, "scene/walls", wall_sites);
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
