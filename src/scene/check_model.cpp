// Rejects features that the chosen model does not have.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "clca/contact/contact_model.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/scene/contact.hpp"
#include "clca/scene/units.hpp"
#include "scene/geometry.hpp"
#include "scene/names.hpp"
#include "scene/sections.hpp"

namespace clca::scene {

namespace {

[[noreturn]] void refuse_yet(const TextLocation& location, std::string_view path,
                             std::string_view what) {
  fail(location, fmt::format("{}: model contact {} yet, model automaton does; remove it, or say "
                             "'model: automaton'",
                             path, what));
}

/// Features that the contact model lacks.
void check_able(const Value& root) {
  if (const Value* walls = root.find("walls")) {
    for (const Entry& wall : walls->entries) {
      const Value* passive = wall.value.find("passive");
      if (passive != nullptr && passive->text == "overlap") {
        refuse_yet(passive->location, fmt::format("walls.{}.passive", wall.key),
                   "lets nothing overlap");
      }
    }
  }
}

void check_shapes(const Scene& scene, const Value& value) {
  const bool rolling = scene.contact.rolling != contact::Rolling::none;
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const Species& species = scene.species[i];
    const TextLocation& location = value.entries[i].location;
    if (rolling && !lattice::centred(species.shape).is_round()) {
      fail(location, fmt::format("species.{}: only hexagons and discs roll; give it the shape of "
                                 "one, or say 'contact.rolling: none'",
                                 species.name));
    }
  }
}

/// In models of one site: a void takes the place of a whole grain.
void check_single_sites(const Scene& scene, const Value& species) {
  for (std::size_t i = 0; i < scene.species.size(); ++i) {
    const std::size_t sites = scene.species[i].shape.size();
    if (sites != 1) {
      fail(species.entries[i].location,
           fmt::format("species.{}: grains of model {} have one site, these have {}; give it "
                       "'shape: {{hexagon: 0}}'",
                       scene.species[i].name, name_of(kModelNames, scene.model), sites));
    }
  }
}

void check_standing(const Scene& scene, const Value& root) {
  if (const Value* walls = root.find("walls")) {
    for (const Entry& wall : walls->entries) {
      if (const Value* motion = wall.value.find("motion")) {
        fail(motion->location,
             fmt::format("walls.{}.motion: model {} has no walls that move, model automaton "
                         "does; remove it, or say 'model: automaton'",
                         wall.key, name_of(kModelNames, scene.model)));
      }
    }
  }
}

/// In a narrow periodic box two grains would touch on both sides, and have one contact.
void check_periodic_width(const Scene& scene, const Value& box) {
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
    fail(
        box.find("width")->location,
        fmt::format("box.width: {} columns, and in a periodic box of less than {} two grains may "
                    "touch on both sides, which model contact does not take; make the width {:.1f} "
                    "or more",
                    columns, needed, std::floor(10 * needed * lattice::kColumnPitch) / 10));
  }
}

/// Checks stages once the time step is known.
void check_vessels(const Scene& scene, const Value& stages) {
  contact::Vessel vessel;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    if (stage.fill && stage.fill->method == FillMethod::deposition && vessel.angle != 0) {
      fail(
          stages.items[i].find("fill")->location,
          fmt::format("stages.{}.fill: deposition needs a vessel that stands upright; use 'method: "
                      "random'",
                      stage.name));
    }
    try {
      vessel = vessel_in(scene, stage, vessel);
    } catch (const std::invalid_argument& error) {
      fail(stages.items[i].find("vessel")->location,
           fmt::format("stages.{}.vessel: {}; a step takes {}", stage.name, error.what(),
                       conversion(scene)->time_text(1)));
    }
    if (vessel.turn_steps > 0) {
      vessel.angle += 1;  // somewhere else in the end
    }
  }
}

}  // namespace

void check_weight_paths(const TextLocation& location, const std::string& path, const Scene& scene) {
  const bool overlaps = std::ranges::any_of(
      scene.walls, [](const Wall& wall) { return wall.passive == grains::Passive::overlap; });
  const bool turns = std::ranges::any_of(
      scene.stages, [](const Stage& stage) { return stage.vessel.has_value(); });
  if (overlaps || turns) {
    fail(location, fmt::format("{}: no paths of weight {}", path,
                               overlaps ? "with a wall that moves with passive: overlap"
                                        : "in a vessel that tilts or moves"));
  }
}

void check_model(const Scene& scene, const Value& root) {
  if (scene.model == Model::contact) {
    check_able(root);
    check_shapes(scene, *root.find("species"));
    check_periodic_width(scene, *root.find("box"));
  } else if (scene.model != Model::automaton) {
    check_single_sites(scene, *root.find("species"));
    check_standing(scene, root);
  }
}

void check_time_step(const Scene& scene, const Value& root) {
  if (scene.model != Model::contact) {
    return;
  }
  const contact::Parameters parameters = contact_parameters(scene);
  try {
    contact::gravity(parameters);
  } catch (const std::invalid_argument&) {
    const Value* block = root.find("contact");
    fail((block != nullptr ? *block : root).location,
         fmt::format(
             "contact: a resolution of {} and a fall height of {} give no time step: gravity "
             "would be {:.3g} lattice spacings per step squared, and may be {:.3g} to {:.3g}",
             parameters.resolution, parameters.fall_height,
             parameters.resolution * parameters.resolution / (2 * parameters.fall_height),
             contact::kMinGravity, contact::kMaxGravity));
  }
  check_vessels(scene, *root.find("stages"));
}

}  // namespace clca::scene
