// Checks of the scene as a whole.

#include <algorithm>

#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Refuses a thing under `key` for which `used(scene, index)` is false.
template <class Use>
void require_use(const Place& root, std::string_view key, std::string_view advice, Use used) {
  const Value* things = root.find(key);
  for (std::size_t i = 0; things != nullptr && i < things->entries.size(); ++i) {
    const Entry& entry = things->entries[i];
    if (!used(root.scene, i)) {
      fail(entry.location, "{}.{} is not used; {}", key, entry.key, advice);
    }
  }
}

template <class Items>
void require_none(const Items& items, const Place& root, const char* key, const char* what) {
  if (!items.empty()) {
    fail(root.at(key),
         "nothing would be written; they {} at the steps of output.series, so remove its none, or "
         "them",
         what);
  }
}

bool opens(const Scene& scene, std::size_t source) {
  return std::ranges::any_of(scene.stages, [source](const Stage& stage) {
    return std::ranges::find(stage.sources, source) != stage.sources.end();
  });
}

bool stands_or_moves(const Scene& scene, std::size_t wall) {
  return !scene.walls[wall].motion || std::ranges::any_of(scene.stages, [wall](const Stage& stage) {
    return std::ranges::find(stage.move, wall) != stage.move.end();
  });
}

bool fills(const Scene& scene, std::size_t species) {
  return std::ranges::any_of(scene.stages, [species](const Stage& stage) {
    return stage.fill && has_species(*stage.fill, species);
  });
}

bool appears(const Scene& scene, std::size_t species) {
  return fills(scene, species) ||
         std::ranges::any_of(scene.sources, [species](const Source& source) {
           return source.weights[species] > 0;
         });
}

}  // namespace

void check_use(const Place& root) {
  const Scene& scene = root.scene;
  require_use(root, "walls", "name it under move in a stage", stands_or_moves);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const std::string& name = scene.walls[i].name;
    if (name.find_first_not_of("0123456789") == std::string::npos) {
      fail(root.at("walls").value.entries[i].location,
           "walls: the name {} is the number of a particle in tables of contacts; give it a letter",
           name);
    }
  }
  require_use(root, "sources", "name it under sources in a stage", opens);
  if (!scene.output.series) {
    require_none(scene.probes, root, "probes", "have rows");
    require_none(scene.lines, root, "lines", "are observed");
  }
  if (scene.begin) {  // which may have particles of any species
    return;
  }
  bool any = !scene.sources.empty();
  for (std::size_t species = 0; species < scene.species.size(); ++species) {
    any = any || fills(scene, species);
  }
  if (!any) {
    fail(root.at("stages"),
         "no particles; give a stage a fill or a source, or begin with another run");
  }
  require_use(root, "species", "give it a count in a fill, or a source", appears);
}

}  // namespace clca::scene
