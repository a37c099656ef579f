// Rejects features that the chosen model does not have.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/scene/units.hpp"
#include "scene/geometry.hpp"
#include "scene/names.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

/// Walls that only the automaton has.
void check_walls_of_model(const PlacedValue& root) {
  const Scene& scene = root.scene;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const PlacedValue walls = root.at("walls");
    const PlacedValue wall = walls.inside(walls.value.entries[i]);
    if (scene.model == Model::contact && scene.walls[i].passive == grains::Passive::overlap) {
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
      scene.model == Model::contact && scene.contact.rolling != contact::Rolling::none;
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
      kinds.push_back({lattice::centred(species.shape.rotated(degrees / kDegreesPerSixth))});
    }
  }
  const int columns = lattice_of(scene.box).columns();
  const int needed = contact::needed_columns(kinds);
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
      vessel = vessel_in(scene, stage, vessel);
    } catch (const std::invalid_argument& error) {
      fail(fields.at("vessel"), "{}; a step takes {}", error.what(),
           conversion(scene)->time_text(1));
    }
    if (vessel.turn_steps > 0) {
      vessel.angle += 1;  // somewhere else in the end
    }
  }
}

}  // namespace

bool lets_overlap(const Scene& scene) {
  return std::ranges::any_of(
      scene.walls, [](const Wall& wall) { return wall.passive == grains::Passive::overlap; });
}

void check_weight_paths(const PlacedValue& place) {
  const Scene& scene = place.scene;
  const bool turns = std::ranges::any_of(
      scene.stages, [](const Stage& stage) { return stage.vessel.has_value(); });
  if (lets_overlap(scene) || turns) {
    fail(place, "no paths of weight {}",
         lets_overlap(scene) ? "with a wall that moves with passive: overlap"
                             : "in a vessel that tilts or moves");
  }
}

void check_model(const PlacedValue& root) {
  const Model model = root.scene.model;
  if (model == Model::automaton) {
    return;
  }
  if (model == Model::contact) {
    check_walls_of_model(root);
  }
  check_shapes(root.scene, root.at("species").value);
  if (model == Model::contact) {
    check_periodic_width(root.at("box"));
  } else {
    check_walls_of_model(root);
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

}  // namespace clca::scene
