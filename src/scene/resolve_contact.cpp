// What a scene chooses of the contact model as the text of a scene.

#include <fmt/format.h>

#include "scene/names.hpp"
#include "scene/resolve_text.hpp"

namespace clca::scene {

std::string contact_block(const contact::Parameters& contact) {
  return fmt::format(
      "\ncontact:\n  friction: {}\n  wall_friction: {}\n  rolling: {}\n  rolling_friction: {}\n"
      "  restitution: {}\n  sweeps: {}\n  resolution: {}\n  fall_height: {}\n"
      "  sleeping: {}\n",
      contact.friction, contact.wall_friction, name_of(kRollingNames, contact.rolling),
      contact.rolling_friction, contact.restitution, contact.sweeps, contact.resolution,
      contact.fall_height > 0 ? fmt::format("{}", contact.fall_height) : std::string(kAutoHeight),
      contact.sleeping);
}

std::string units_line(const Units& units) {
  return fmt::format("\nunits: {{spacing: {} m, gravity: {}}}\n", units.spacing, units.gravity);
}

}  // namespace clca::scene
