// Checks of the scene as a whole.

#include <fmt/format.h>

#include <algorithm>

#include "scene/sections.hpp"

namespace clca::scene {

namespace {

template <class Use>
void require_use(const Scene& scene, const Value& entries, std::string_view path,
                 std::string_view advice, Use used) {
  for (std::size_t i = 0; i < entries.entries.size(); ++i) {
    const Entry& entry = entries.entries[i];
    if (!used(scene, i)) {
      fail(entry.location, fmt::format("{}.{} is not used; {}", path, entry.key, advice));
    }
  }
}

template <class Items>
void require_none(const Items& items, const Value& root, const char* key, const char* what) {
  if (!items.empty()) {
    fail(root.find(key)->location,
         fmt::format(
             "{}: nothing would be written; they {} at the steps of output.series, so remove "
             "its none, or them",
             key, what));
  }
}

bool opens(const Scene& scene, std::size_t source) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [source](const Stage& stage) {
    return std::find(stage.sources.begin(), stage.sources.end(), source) != stage.sources.end();
  });
}

bool stands_or_moves(const Scene& scene, std::size_t wall) {
  return !scene.walls[wall].motion ||
         std::any_of(scene.stages.begin(), scene.stages.end(), [wall](const Stage& stage) {
           return std::find(stage.move.begin(), stage.move.end(), wall) != stage.move.end();
         });
}

bool fills(const Scene& scene, std::size_t species) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [species](const Stage& stage) {
    return stage.fill && has_species(*stage.fill, species);
  });
}

bool appears(const Scene& scene, std::size_t species) {
  return fills(scene, species) ||
         std::any_of(scene.sources.begin(), scene.sources.end(),
                     [species](const Source& source) { return source.weights[species] > 0; });
}

}  // namespace

void check_use(const Scene& scene, const Value& root) {
  if (const Value* walls = root.find("walls")) {
    require_use(scene, *walls, "walls", "name it under move in a stage", stands_or_moves);
    for (const Entry& wall : walls->entries) {
      if (wall.key.find_first_not_of("0123456789") == std::string::npos) {
        fail(wall.location, fmt::format("walls: the name {} is the number of a particle in tables "
                                        "of contacts; give it a letter",
                                        wall.key));
      }
    }
  }
  if (const Value* sources = root.find("sources")) {
    require_use(scene, *sources, "sources", "name it under sources in a stage", opens);
  }
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
    fail(root.find("stages")->location,
         "stages: no particles; give a stage a fill or a source, or begin with another run");
  }
  require_use(scene, *root.find("species"), "species", "give it a count in a fill, or a source",
              appears);
}

}  // namespace clca::scene
