// Stages in their order: what one of them has done with a wall binds those that follow.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// A name in a list of a stage.
struct Mention {
  const Stage& stage;
  std::string_view key;  ///< of the list
  const Wall& wall;
  const Place& place;
};

[[noreturn]] void fail(const Mention& mention, std::string_view reason) {
  fail(mention.place, fmt::format("stages.{}.{}: wall '{}' {}", mention.stage.name, mention.key,
                                  mention.wall.name, reason));
}

bool names(const std::vector<std::size_t>& walls, std::size_t wall) {
  return std::find(walls.begin(), walls.end(), wall) != walls.end();
}

/// Which walls are there, and since which stage they are or are not.
class History {
 public:
  explicit History(const Scene& scene)
      : scene_(scene), there_(walls_there_first(scene)), since_(scene.walls.size(), nullptr) {}

  void check(const Stage& stage, const Value& value) {
    for_each(stage, value, "remove", stage.remove, &History::remove);
    for_each(stage, value, "insert", stage.insert, &History::insert);
    for_each(stage, value, "move", stage.move, &History::move);
  }

 private:
  using Change = void (History::*)(std::size_t, const Mention&);

  void for_each(const Stage& stage, const Value& value, std::string_view key,
                const std::vector<std::size_t>& walls, Change change) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const Mention mention = {stage, key, scene_.walls[walls[i]], value.find(key)->items[i].place};
      (this->*change)(walls[i], mention);
    }
  }

  void remove(std::size_t wall, const Mention& mention) {
    if (names(mention.stage.insert, wall)) {
      fail(mention, "is under insert too");
    }
    require(wall, mention);
    there_[wall] = false;
    since_[wall] = &mention.stage;
  }

  void insert(std::size_t wall, const Mention& mention) {
    if (there_[wall]) {
      fail(mention, fmt::format("is there since stage '{}'", since_[wall]->name));
    }
    there_[wall] = true;
    since_[wall] = &mention.stage;
  }

  void move(std::size_t wall, const Mention& mention) {
    if (!scene_.walls[wall].motion) {
      fail(mention, "has no motion");
    }
    require(wall, mention);
  }

  void require(std::size_t wall, const Mention& mention) const {
    if (there_[wall]) {
      return;
    }
    if (since_[wall] != nullptr) {
      fail(mention, fmt::format("is gone since stage '{}'", since_[wall]->name));
    }
    const auto& stages = scene_.stages;
    const auto first = std::find_if(stages.begin(), stages.end(), [wall](const Stage& stage) {
      return names(stage.insert, wall);
    });
    fail(mention, fmt::format("is not there before stage '{}' inserts it", first->name));
  }

  const Scene& scene_;
  std::vector<bool> there_;
  std::vector<const Stage*> since_;  // null since the start
};

void check_names(const std::vector<Stage>& stages, const Value& list) {
  std::map<std::string_view, std::size_t> known;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!known.emplace(stages[i].name, i).second) {
      fail(list.items[i].find("name")->place,
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
