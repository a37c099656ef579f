// Checks walls across stages: removing, moving and inserting must be in a possible order.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// A name in a list of a stage.
struct StageEntry {
  const Stage& stage;
  std::string_view key;  ///< of the list
  const Wall& wall;
  const TextLocation& location;
};

[[noreturn]] void fail(const StageEntry& entry, std::string_view reason) {
  fail(entry.location, fmt::format("stages.{}.{}: wall '{}' {}", entry.stage.name, entry.key,
                                   entry.wall.name, reason));
}

bool names(const std::vector<std::size_t>& walls, std::size_t wall) {
  return std::find(walls.begin(), walls.end(), wall) != walls.end();
}

/// Which walls are present, and since which stage.
class History {
 public:
  explicit History(const Scene& scene)
      : scene_(scene), there_(walls_present_at_start(scene)), since_(scene.walls.size(), nullptr) {}

  void check(const Stage& stage, const Value& value) {
    for_each(stage, value, "remove", stage.remove, &History::remove);
    for_each(stage, value, "insert", stage.insert, &History::insert);
    for_each(stage, value, "move", stage.move, &History::move);
  }

 private:
  using Change = void (History::*)(std::size_t, const StageEntry&);

  void for_each(const Stage& stage, const Value& value, std::string_view key,
                const std::vector<std::size_t>& walls, Change change) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const StageEntry entry = {stage, key, scene_.walls[walls[i]],
                                value.find(key)->items[i].location};
      (this->*change)(walls[i], entry);
    }
  }

  void remove(std::size_t wall, const StageEntry& entry) {
    if (names(entry.stage.insert, wall)) {
      fail(entry, "is under insert too");
    }
    require(wall, entry);
    there_[wall] = false;
    since_[wall] = &entry.stage;
  }

  void insert(std::size_t wall, const StageEntry& entry) {
    if (there_[wall]) {
      fail(entry, fmt::format("is there since stage '{}'", since_[wall]->name));
    }
    there_[wall] = true;
    since_[wall] = &entry.stage;
  }

  void move(std::size_t wall, const StageEntry& entry) {
    if (!scene_.walls[wall].motion) {
      fail(entry, "has no motion");
    }
    require(wall, entry);
  }

  void require(std::size_t wall, const StageEntry& entry) const {
    if (there_[wall]) {
      return;
    }
    if (since_[wall] != nullptr) {
      fail(entry, fmt::format("is gone since stage '{}'", since_[wall]->name));
    }
    const auto& stages = scene_.stages;
    const auto first = std::find_if(stages.begin(), stages.end(), [wall](const Stage& stage) {
      return names(stage.insert, wall);
    });
    fail(entry, fmt::format("is not there before stage '{}' inserts it", first->name));
  }

  const Scene& scene_;
  std::vector<bool> there_;
  std::vector<const Stage*> since_;  // null since the start
};

void check_names(const std::vector<Stage>& stages, const Value& list) {
  std::map<std::string_view, std::size_t> known;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!known.emplace(stages[i].name, i).second) {
      fail(list.items[i].find("name")->location,
           fmt::format("stages: the name '{}' is taken", stages[i].name));
    }
  }
}

}  // namespace

void check_history(const Scene& scene, const Value& list) {
  check_names(scene.stages, list);
  History history(scene);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    history.check(scene.stages[i], list.items[i]);
  }
}

}  // namespace clca::scene
