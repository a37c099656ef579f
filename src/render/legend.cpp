#include "clca/render/legend.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/colors.hpp"

/// Corners of icons, in JSON in whole thousandths, which are short.
template <>
struct nlohmann::adl_serializer<Eigen::Vector2d> {
  static void to_json(json& to, const Eigen::Vector2d& point) {
    to = {std::lround(1000 * point.x()), std::lround(1000 * point.y())};
  }
  static void from_json(const json& from, Eigen::Vector2d& point) {
    point = Eigen::Vector2d(from.at(0), from.at(1)) / 1000;
  }
};

namespace clca::image {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Rgb, red, green, blue)
}  // namespace clca::image

namespace clca::render {

// As JSON.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::Patch, label, color, outline, size)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::ColorBar, label, low, high, diverging, below, above)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::Line, label, width, length, color, arrow)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend, patches, bars, lines, fade)

void add_wall_entries(Legend& legend, bool moving) {
  const std::vector<Eigen::Vector2d> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  legend.patches.push_back({.label = "wall", .color = kWallColor, .outline = square});
  if (moving) {
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
    Legend::ColorBar& bar = result.bars[i];
    const Legend::ColorBar& other = second.bars[i];
    if (bar.label != other.label || bar.low != other.low || bar.high != other.high) {
      return std::nullopt;
    }
    bar.below = bar.below || other.below;
    bar.above = bar.above || other.above;
  }
  for (const Legend::Patch& patch : second.patches) {
    if (std::ranges::find(first.patches, patch) == first.patches.end()) {
      result.patches.push_back(patch);
    }
  }
  return result;
}

std::string to_text(const Legend& legend) {
  return nlohmann::json(legend).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

Legend parse_legend(const std::string& text) {
  try {
    return nlohmann::json::parse(text).get<Legend>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace clca::render
