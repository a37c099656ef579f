#include "clca/render/overlays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "render/annotations.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

constexpr double kForceFade = 0.55;
constexpr double kMinForceWidth = 0.25;  // lattice spacings
constexpr double kMaxForceWidth = 1.2;
constexpr Rgb kForceColor = {139, 0, 18};

constexpr double kArrowFade = 0.6;
constexpr double kMaxArrowShare = 0.9;  // of a cell
constexpr double kArrowWidth = 0.075;   // in cells
constexpr double kPalest = 0.55;        // share of paper in the weakest arrows
constexpr Rgb kCutArrowColor = {176, 32, 16};

double force_width(double share) {
  return kMinForceWidth + (kMaxForceWidth - kMinForceWidth) * std::min(share, 1.0);
}

Rgb arrow_color(double share) {
  return mixed(kInk, kPaper, kPalest * (1 - std::min(share, 1.0)));
}

/// Stable sort by strength, strongest last.
template <class Item, class StrengthOf>
std::vector<Item> by_strength(std::span<const Item> items, StrengthOf strength_of) {
  std::vector<Item> sorted;
  std::copy_if(items.begin(), items.end(), std::back_inserter(sorted),
               [&](const Item& item) { return strength_of(item) >= 0; });  // not NaN
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Item& a, const Item& b) { return strength_of(a) < strength_of(b); });
  return sorted;
}

}  // namespace

Overlay force_network(std::span<const ForceLine> lines, double strongest) {
  Overlay overlay = {.strokes = {}, .fade = kForceFade};
  if (!(strongest > 0)) {
    return overlay;
  }
  for (const ForceLine& line :
       by_strength(lines, [](const ForceLine& item) { return item.strength; })) {
    if (line.strength > 0) {
      overlay.strokes.push_back(
          {line.from, line.to, force_width(line.strength / strongest), kForceColor, false});
    }
  }
  return overlay;
}

Legend::Line force_key(double strongest, std::string label) {
  return {std::move(label), strongest > 0 ? kMaxForceWidth : kMinForceWidth, 0, kForceColor, false};
}

Overlay arrow_field(std::span<const FieldArrow> arrows, double cell, double longest) {
  Overlay overlay = {.strokes = {}, .fade = kArrowFade};
  if (!(longest > 0 && cell > 0)) {
    return overlay;
  }
  for (const FieldArrow& arrow :
       by_strength(arrows, [](const FieldArrow& item) { return item.vector.norm(); })) {
    const double length = arrow.vector.norm();
    const Eigen::Vector2d half =
        kMaxArrowShare * cell / std::max(length, longest) / 2 * arrow.vector;
    overlay.strokes.push_back({arrow.at - half, arrow.at + half, kArrowWidth * cell,
                               length > longest ? kCutArrowColor : arrow_color(length / longest),
                               true});
  }
  return overlay;
}

Legend::Line arrow_key(double cell, double longest, const UnitName& unit) {
  if (!(longest > 0 && cell > 0)) {
    return {fmt::format("0 {}", unit.several), 0, 0, arrow_color(0), true};
  }
  const double shown = round_length(longest);
  const double share = shown / longest;
  return {fmt::format("{:g} {}", shown, shown == 1 ? unit.one : unit.several), kArrowWidth * cell,
          kMaxArrowShare * cell * share, arrow_color(share), true};
}

Legend::Line cut_arrow_key(double cell, std::string label) {
  return {std::move(label), kArrowWidth * cell, 0, kCutArrowColor, true};
}

}  // namespace clca::render
