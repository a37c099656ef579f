#include "run/bodies.hpp"

#include <fmt/format.h>

#include <string>
#include <variant>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/run/quantity.hpp"

namespace clca::run {

namespace {

/// Of the line from one end to the other, downwards, or to the right.
Eigen::Vector2d downwards(const Eigen::Vector2d& line) {
  const Eigen::Vector2d unit = line.normalized();
  return unit.y() > 0 || (unit.y() == 0 && unit.x() < 0) ? -unit : unit;
}

std::optional<Eigen::Vector2d> part_direction(const scene::WallPart& part) {
  const auto* line = std::get_if<lattice::Segment>(&part);
  if (line != nullptr && line->from != line->to) {
    return downwards(line->to - line->from);
  }
  if (const auto* box = std::get_if<lattice::Rectangle>(&part)) {
    const bool stands = box->right - box->left < box->top - box->bottom;
    return stands ? Eigen::Vector2d(0, -1) : Eigen::Vector2d(1, 0);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Eigen::Vector2d> direction_of(const scene::Scene& scene, grains::Owner body) {
  constexpr double kParallel = 1e-9;
  if (contact::is_side(body)) {
    const bool stands = body == contact::kLeftSide || body == contact::kRightSide;
    return stands ? Eigen::Vector2d(0, -1) : Eigen::Vector2d(1, 0);
  }
  std::optional<Eigen::Vector2d> all;
  for (const scene::WallPart& part : scene.walls[grains::wall_number(body)].parts) {
    const auto direction = part_direction(part);
    if (!direction || (all && (*all - *direction).norm() > kParallel)) {
      return std::nullopt;
    }
    all = direction;
  }
  return all;
}

// No wall has a dot in its name, so none is called as a side of the box.
std::string body_name(const scene::Scene& scene, grains::Owner owner) {
  switch (owner) {
    case contact::kFloor:
      return "box.floor";
    case contact::kCeiling:
      return "box.top";
    case contact::kLeftSide:
      return "box.left";
    case contact::kRightSide:
      return "box.right";
    default:
      return grains::is_particle(owner) ? fmt::format("{}", owner)
                                        : scene.walls[grains::wall_number(owner)].name;
  }
}

std::vector<grains::Owner> walls_and_sides(const scene::Scene& scene) {
  std::vector<grains::Owner> all;
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    all.push_back(grains::wall_code(wall));
  }
  all.insert(all.end(),
             {contact::kFloor, contact::kCeiling, contact::kLeftSide, contact::kRightSide});
  return all;
}

}  // namespace clca::run
