// Checks of the scene as a whole: the model can do what the scene asks for, time step and vessel
// are possible, everything declared is used, and stages remove, move or insert walls that they can.

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/scene/units.hpp"
#include "clca/scene/walls.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Walls that only the automaton has.
void check_walls_of_model(const PlacedValue& root) {
  const Scene& scene = root.scene;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const PlacedValue walls = root.at("walls");
    const PlacedValue wall = walls.at(walls.value.entries[i]);
    if (scene.model == Model::contact &&
        scene.walls[i].passive_rule == grains::PassiveRule::overlap) {
      fail(wall.at("passive"),
           "model contact lets nothing overlap yet, model automaton does; remove it, or say "
           "'model: automaton'");
    }
    if (scene.model != Model::contact && scene.walls[i].motion) {
      fail(wall.at("motion"),
           "model {} has no walls that move, model automaton does; remove it, or say 'model: "
           "automaton'",
           name_of(kModelNames, scene.model));
    }
  }
}

/// Particles that roll are round. In models of one site, a void takes the place of a whole grain.
void check_shapes(const Scene& scene, const Value& value) {
  const bool rolling =
      scene.model == Model::contact && scene.contact_parameters.rolling != contact::Rolling::none;
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const Species& species = scene.species[i];
    const TextLocation& location = value.entries[i].location;
    if (rolling && !lattice::centred(species.shape).is_round()) {
      fail(location,
           "species.{}: only hexagons and discs roll; give it the shape of one, or say "
           "'contact.rolling: none'",
           species.name);
    }
    if (scene.model != Model::contact && species.shape.size() != 1) {
      fail(location,
           "species.{}: grains of model {} have one site, these have {}; give it 'shape: "
           "{{hexagon: 0}}'",
           species.name, name_of(kModelNames, scene.model), species.shape.size());
    }
  }
}

/// In a narrow periodic box two grains would touch on both sides, and have one contact.
void check_periodic_width(const PlacedValue& box) {
  const Scene& scene = box.scene;
  if (!scene.box.periodic) {
    return;
  }
  std::vector<grains::Kind> kinds;
  for (const Species& species : scene.species) {
    for (const int degrees : species.orientations) {
      kinds.push_back({lattice::centred(species.shape.rotated(degrees / kOrientationStep))});
    }
  }
  const int columns = lattice_of(scene.box).columns();
  const int needed = contact::min_periodic_columns(kinds);
  if (columns < needed) {
    fail(box.at("width"),
         "{} columns, and in a periodic box of less than {} two grains may touch on "
         "both sides, which model contact does not take; make the width {:.1f} or more",
         columns, needed, std::floor(10 * needed * lattice::kColumnPitch) / 10);
  }
}

/// Checks stages once the time step is known.
void check_vessels(const PlacedValue& stages) {
  const Scene& scene = stages.scene;
  contact::Vessel vessel;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    const PlacedValue fields = {stages.value.items[i], join_path(stages.path, stage.name), scene};
    if (stage.fill && stage.fill->method == FillMethod::deposition && vessel.angle != 0) {
      fail(fields.at("fill"),
           "deposition needs a vessel that stands upright; use 'method: random'");
    }
    try {
      vessel = vessel_at_start(scene, stage, vessel);
    } catch (const std::invalid_argument& error) {
      fail(fields.at("vessel"), "{}; a step takes {}", error.what(),
           unit_conversion(scene)->time_text(1));
    }
    if (vessel.turn_steps > 0) {
      vessel.angle += 1;  // somewhere else in the end
    }
  }
}

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
         "nothing would be written; they {} at the steps of output.series: set it, or remove them",
         what);
  }
}

bool source_opens(const Scene& scene, std::size_t source) {
  return std::ranges::any_of(scene.stages, [source](const Stage& stage) {
    return std::ranges::count(stage.open_sources, source) > 0;
  });
}

bool wall_stands_or_moves(const Scene& scene, std::size_t wall) {
  return !scene.walls[wall].motion || std::ranges::any_of(scene.stages, [wall](const Stage& stage) {
    return std::ranges::count(stage.moving_walls, wall) > 0;
  });
}

bool fill_has_species(const Scene& scene, std::size_t species) {
  return std::ranges::any_of(scene.stages, [species](const Stage& stage) {
    return stage.fill && places_species(*stage.fill, species);
  });
}

bool species_appears(const Scene& scene, std::size_t species) {
  return fill_has_species(scene, species) ||
         std::ranges::any_of(scene.sources, [species](const Source& source) {
           return source.species_weights[species] > 0;
         });
}

}  // namespace

bool walls_may_overlap(const Scene& scene) {
  return std::ranges::any_of(scene.walls, [](const Wall& wall) {
    return wall.passive_rule == grains::PassiveRule::overlap;
  });
}

void check_weight_paths(const PlacedValue& place) {
  const Scene& scene = place.scene;
  const bool turns = std::ranges::any_of(
      scene.stages, [](const Stage& stage) { return stage.vessel_motion.has_value(); });
  if (walls_may_overlap(scene) || turns) {
    fail(place, "no paths of weight {}",
         walls_may_overlap(scene) ? "with a wall that moves with passive: overlap"
                                  : "in a vessel that tilts or moves");
  }
}

void check_model(const PlacedValue& root) {
  const Model model = root.scene.model;
  if (model == Model::automaton) {
    return;
  }
  check_walls_of_model(root);
  check_shapes(root.scene, root.at("species").value);
  if (model == Model::contact) {
    check_periodic_width(root.at("box"));
  }
}

void check_time_step(const PlacedValue& root) {
  const Scene& scene = root.scene;
  if (scene.model != Model::contact) {
    return;
  }
  const contact::Parameters parameters = contact_parameters(scene);
  try {
    contact::gravity(parameters);
  } catch (const std::invalid_argument&) {
    const Value* block = root.find("contact");
    fail((block != nullptr ? *block : root.value).location,
         "contact: a resolution of {} and a fall height of {} give no time step: gravity would be "
         "{:.3g} lattice spacings per step squared, and may be {:.3g} to {:.3g}",
         parameters.resolution, parameters.fall_height,
         parameters.resolution * parameters.resolution / (2 * parameters.fall_height),
         contact::kMinGravity, contact::kMaxGravity);
  }
  check_vessels(root.at("stages"));
}

void check_stage_order(const PlacedValue& list) {
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
        return std::ranges::count(stage.inserted_walls, wall) > 0;
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
    for_each("remove", stage.removed_walls, [&](std::size_t wall, const PlacedValue& entry) {
      if (std::ranges::count(stage.inserted_walls, wall) > 0) {
        refuse(wall, entry, "is under insert too");
      }
      require(wall, entry);
      there[wall] = false;
      since[wall] = &stage;
    });
    for_each("insert", stage.inserted_walls, [&](std::size_t wall, const PlacedValue& entry) {
      if (there[wall]) {
        refuse(wall, entry, fmt::format("is there since stage '{}'", since[wall]->name));
      }
      there[wall] = true;
      since[wall] = &stage;
    });
    for_each("move", stage.moving_walls, [&](std::size_t wall, const PlacedValue& entry) {
      if (!scene.walls[wall].motion) {
        refuse(wall, entry, "has no motion");
      }
      require(wall, entry);
    });
  }
}

void check_unused_items(const PlacedValue& root) {
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
  if (scene.initial_state) {  // which may have particles of any species
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
