#include "clca/render/legend.hpp"

#include <algorithm>
#include <optional>

#include "render/colors.hpp"
#include "render/internal/legend_json.hpp"

namespace clca::render {

void add_walls(Legend& legend, const ShownWalls& walls) {
  const std::vector<Eigen::Vector2d> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (walls.standing) {
    legend.patches.push_back({.label = "wall", .color = kWallColor, .outline = square});
  }
  if (walls.moving) {
    legend.patches.push_back(
        {.label = "moving wall", .color = kMovingWallColor, .outline = square});
  }
}

std::optional<Legend> common_legend(const Legend& first, const Legend& second) {
  Legend result = first;
  if (first.fade != second.fade || first.lines != second.lines ||
      first.bars.size() != second.bars.size()) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < result.bars.size(); ++i) {
    Legend::Bar& bar = result.bars[i];
    const Legend::Bar& other = second.bars[i];
    if (bar.label != other.label || bar.low != other.low || bar.high != other.high) {
      return std::nullopt;
    }
    bar.below = bar.below || other.below;
    bar.above = bar.above || other.above;
  }
  for (const Legend::Patch& patch : second.patches) {
    if (std::find(first.patches.begin(), first.patches.end(), patch) == first.patches.end()) {
      result.patches.push_back(patch);
    }
  }
  return result;
}

std::string to_text(const Legend& legend) {
  return nlohmann::json(legend).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

Legend legend_of(const std::string& text) {
  try {
    return nlohmann::json::parse(text).get<Legend>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace clca::render
