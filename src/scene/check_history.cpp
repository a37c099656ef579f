// Checks walls across stages: removing, moving and inserting must be in a possible order.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

bool names(const std::vector<std::size_t>& walls, std::size_t wall) {
  return std::ranges::find(walls, wall) != walls.end();
}

/// Which walls are present, and since which stage.
class History {
 public:
  explicit History(const Scene& scene)
      : scene_(scene), there_(walls_present_at_start(scene)), since_(scene.walls.size(), nullptr) {}

  void check(const Stage& stage, const Place& fields) {
    for_each(fields, "remove", stage.remove, [&](std::size_t wall, const Place& entry) {
      if (names(stage.insert, wall)) {
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
    const auto first = std::ranges::find_if(
        scene_.stages, [wall](const Stage& stage) { return names(stage.insert, wall); });
    refuse(wall, entry, fmt::format("is not there before stage '{}' inserts it", first->name));
  }

  const Scene& scene_;
  std::vector<bool> there_;
  std::vector<const Stage*> since_;  // null since the start
};

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

}  // namespace clca::scene
