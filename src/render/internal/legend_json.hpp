#pragma once
// A legend as JSON.

#include <cmath>
#include <nlohmann/json.hpp>

#include "clca/render/legend.hpp"

/// Of icons: in thousandths, which are short.
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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::Patch, label, color, outline, size)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::Bar, label, low, high, diverging, below, above)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend::Line, label, width, length, color, arrow)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Legend, patches, bars, lines, fade)
}  // namespace clca::render
