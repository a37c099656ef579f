// Checks of the scene as a whole, and of walls across stages: removing, moving and inserting must
// be in a possible order.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Which walls are present, and since which stage.
class History {
 public:
  explicit History(const Scene& scene)
      : scene_(scene), there_(walls_present_at_start(scene)), since_(scene.walls.size(), nullptr) {}

  void check(const Stage& stage, const Place& fields) {
    for_each(fields, "remove", stage.remove, [&](std::size_t wall, const Place& entry) {
      if (std::ranges::count(stage.insert, wall) > 0) {
        refuse(wall, entry, "is under insert too");
      }
      require(wall, entry);
      there_[wall] = false;
      since_[wall] = &stage;
    });
    for_each(fields, "insert", stage.insert, [&](std::size_t wall, const Place& entry) {
      if (there_[wall]) {
        refuse(wall, entry, fmt::format("is there since stage '{}'", since_[wall]->name));
      }
      there_[wall] = true;
      since_[wall] = &stage;
    });
    for_each(fields, "move", stage.move, [&](std::size_t wall, const Place& entry) {
      if (!scene_.walls[wall].motion) {
        refuse(wall, entry, "has no motion");
      }
      require(wall, entry);
    });
  }

 private:
  /// Calls change(wall, entry) for the walls in a list of a stage.
  template <class Change>
  void for_each(const Place& fields, std::string_view key, const std::vector<std::size_t>& walls,
                const Change& change) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const Place list = fields.at(key);
      change(walls[i], Place{list.value.items[i], list.path, list.scene});
    }
  }

  [[noreturn]] void refuse(std::size_t wall, const Place& entry, std::string_view reason) const {
    fail(entry, "wall '{}' {}", scene_.walls[wall].name, reason);
  }

  void require(std::size_t wall, const Place& entry) const {
    if (there_[wall]) {
      return;
    }
    if (since_[wall] != nullptr) {
      refuse(wall, entry, fmt::format("is gone since stage '{}'", since_[wall]->name));
    }
    const auto first = std::ranges::find_if(scene_.stages, [wall](const Stage& stage) {
      return std::ranges::count(stage.insert, wall) > 0;
    });
    refuse(wall, entry, fmt::format("is not there before stage '{}' inserts it", first->name));
  }

  const Scene& scene_;
  std::vector<bool> there_;
  std::vector<const Stage*> since_;  // null since the start
};

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
    return std::ranges::count(stage.sources, source) > 0;
  });
}

bool stands_or_moves(const Scene& scene, std::size_t wall) {
  return !scene.walls[wall].motion || std::ranges::any_of(scene.stages, [wall](const Stage& stage) {
    return std::ranges::count(stage.move, wall) > 0;
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

void check_history(const Place& list) {
  const std::vector<Stage>& stages = list.scene.stages;
  std::set<std::string_view> known;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!known.insert(stages[i].name).second) {
      fail(list.value.items[i].find("name")->location, "stages: the name '{}' is taken",
           stages[i].name);
    }
  }
  History history(list.scene);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    history.check(stages[i],
                  {list.value.items[i], join_path(list.path, stages[i].name), list.scene});
  }
}

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
