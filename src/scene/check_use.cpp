// Checks of the scene as a whole, and of walls across stages: removing, moving and inserting must
// be in a possible order.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Refuses a thing under `key` for which `used(scene, index)` is false.
template <class Use>
void require_use(const PlacedValue& root, std::string_view key, std::string_view advice, Use used) {
  const Value* things = root.find(key);
  for (std::size_t i = 0; things != nullptr && i < things->entries.size(); ++i) {
    const Entry& entry = things->entries[i];
    if (!used(root.scene, i)) {
      fail(entry.location, "{}.{} is not used; {}", key, entry.key, advice);
    }
  }
}

template <class Items>
void require_none(const Items& items, const PlacedValue& root, const char* key, const char* what) {
  if (!items.empty()) {
    fail(root.at(key),
         "nothing would be written; they {} at the steps of output.series, so remove its none, or "
         "them",
         what);
  }
}

bool source_opens(const Scene& scene, std::size_t source) {
  return std::ranges::any_of(scene.stages, [source](const Stage& stage) {
    return std::ranges::count(stage.sources, source) > 0;
  });
}

bool wall_stands_or_moves(const Scene& scene, std::size_t wall) {
  return !scene.walls[wall].motion || std::ranges::any_of(scene.stages, [wall](const Stage& stage) {
    return std::ranges::count(stage.move, wall) > 0;
  });
}

bool fill_has_species(const Scene& scene, std::size_t species) {
  return std::ranges::any_of(scene.stages, [species](const Stage& stage) {
    return stage.fill && has_species(*stage.fill, species);
  });
}

bool species_appears(const Scene& scene, std::size_t species) {
  return fill_has_species(scene, species) ||
         std::ranges::any_of(scene.sources, [species](const Source& source) {
           return source.weights[species] > 0;
         });
}

}  // namespace

void check_history(const PlacedValue& list) {
  const Scene& scene = list.scene;
  std::set<std::string_view> known;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    if (!known.insert(scene.stages[i].name).second) {
      fail(list.value.items[i].find("name")->location, "stages: the name '{}' is taken",
           scene.stages[i].name);
    }
  }
  std::vector<bool> there = walls_present_at_start(scene);
  std::vector<const Stage*> since(scene.walls.size(), nullptr);  // null since the start
  const auto refuse = [&](std::size_t wall, const PlacedValue& entry, std::string_view reason) {
    fail(entry, "wall '{}' {}", scene.walls[wall].name, reason);
  };
  const auto require = [&](std::size_t wall, const PlacedValue& entry) {
    if (!there[wall] && since[wall] != nullptr) {
      refuse(wall, entry, fmt::format("is gone since stage '{}'", since[wall]->name));
    }
    if (!there[wall]) {
      const auto first = std::ranges::find_if(scene.stages, [wall](const Stage& stage) {
        return std::ranges::count(stage.insert, wall) > 0;
      });
      refuse(wall, entry, fmt::format("is not there before stage '{}' inserts it", first->name));
    }
  };
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    const PlacedValue fields = {list.value.items[i], join_path(list.path, stage.name), scene};
    // Calls change(wall, entry) for the walls in a list of the stage.
    const auto for_each = [&](std::string_view key, const std::vector<std::size_t>& walls,
                              const auto& change) {
      for (std::size_t k = 0; k < walls.size(); ++k) {
        const PlacedValue entries = fields.at(key);
        change(walls[k], PlacedValue{entries.value.items[k], entries.path, scene});
      }
    };
    for_each("remove", stage.remove, [&](std::size_t wall, const PlacedValue& entry) {
      if (std::ranges::count(stage.insert, wall) > 0) {
        refuse(wall, entry, "is under insert too");
      }
      require(wall, entry);
      there[wall] = false;
      since[wall] = &stage;
    });
    for_each("insert", stage.insert, [&](std::size_t wall, const PlacedValue& entry) {
      if (there[wall]) {
        refuse(wall, entry, fmt::format("is there since stage '{}'", since[wall]->name));
      }
      there[wall] = true;
      since[wall] = &stage;
    });
    for_each("move", stage.move, [&](std::size_t wall, const PlacedValue& entry) {
      if (!scene.walls[wall].motion) {
        refuse(wall, entry, "has no motion");
      }
      require(wall, entry);
    });
  }
}

void check_use(const PlacedValue& root) {
  const Scene& scene = root.scene;
  require_use(root, "walls", "name it under move in a stage", wall_stands_or_moves);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const std::string& name = scene.walls[i].name;
    if (name.find_first_not_of("0123456789") == std::string::npos) {
      fail(root.at("walls").value.entries[i].location,
           "walls: the name {} is the number of a particle in tables of contacts; give it a letter",
           name);
    }
  }
  require_use(root, "sources", "name it under sources in a stage", source_opens);
  if (!scene.output.series) {
    require_none(scene.probes, root, "probes", "have rows");
    require_none(scene.lines, root, "lines", "are observed");
  }
  if (scene.begin) {  // which may have particles of any species
    return;
  }
  bool any = !scene.sources.empty();
  for (std::size_t species = 0; species < scene.species.size(); ++species) {
    any = any || fill_has_species(scene, species);
  }
  if (!any) {
    fail(root.at("stages"),
         "no particles; give a stage a fill or a source, or begin with another run");
  }
  require_use(root, "species", "give it a count in a fill, or a source", species_appears);
}

}  // namespace clca::scene
