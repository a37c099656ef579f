#include "clca/render/overlays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "render/annotations.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

constexpr double kForceFade = 0.55;
constexpr double kMinForceWidth = 0.25;  // lattice spacings
constexpr double kMaxForceWidth = 1.2;
constexpr Rgb kForceColor = {139, 0, 18};

constexpr double kArrowFade = 0.6;
constexpr double kArrowShare = 0.9;    // of a cell
constexpr double kArrowWidth = 0.075;  // in cells
constexpr double kPalest = 0.55;       // share of paper in the weakest arrows

double force_width(double share) {
  return kMinForceWidth + (kMaxForceWidth - kMinForceWidth) * std::min(share, 1.0);
}

Rgb arrow_color(double share) {
  return mixed(kInk, kPaper, kPalest * (1 - std::min(share, 1.0)));
}

}  // namespace

Overlay force_network(std::span<const ForceLine> lines, double strongest, std::string label) {
  const double legend_line_width = strongest > 0 ? kMaxForceWidth : kMinForceWidth;
  Overlay overlay = {
      .strokes = {},
      .fade = kForceFade,
      .legend_lines = {{std::move(label), legend_line_width, 0, kForceColor, false}}};
  if (!(strongest > 0)) {
    return overlay;
  }
  std::vector<ForceLine> sorted(lines.begin(), lines.end());
  std::erase_if(sorted, [](const ForceLine& line) { return !(line.strength > 0); });  // nor NaN
  std::ranges::stable_sort(sorted, {}, &ForceLine::strength);
  for (const ForceLine& line : sorted) {
    overlay.strokes.push_back(
        {line.from, line.to, force_width(line.strength / strongest), kForceColor, false});
  }
  return overlay;
}

double typical_length(std::span<const FieldArrow> arrows) {
  double sum = 0;
  double squares = 0;
  for (const FieldArrow& arrow : arrows) {
    if (arrow.vector.allFinite()) {
      sum += arrow.vector.norm();
      squares += arrow.vector.squaredNorm();
    }
  }
  return squares > 0 ? largest_round_number_up_to(1.5 * squares / sum) : 0;
}

Overlay arrow_field(std::span<const FieldArrow> arrows, double cell, double scale,
                    const UnitName& unit) {
  Overlay overlay = {.strokes = {}, .fade = kArrowFade};
  if (!(scale > 0 && cell > 0)) {
    overlay.legend_lines = {{fmt::format("0 {}", unit.plural), 0, 0, arrow_color(0), true}};
    return overlay;
  }
  const double width = kArrowWidth * cell;
  const double shown = largest_round_number_up_to(scale);
  const double share = shown / scale;
  overlay.legend_lines = {{fmt::format("{:g} {}", shown, shown == 1 ? unit.singular : unit.plural),
                           width, kArrowShare * cell * share, arrow_color(share), true}};
  std::vector<FieldArrow> sorted(arrows.begin(), arrows.end());
  std::erase_if(sorted, [](const FieldArrow& arrow) { return arrow.vector.hasNaN(); });
  std::ranges::stable_sort(sorted, {}, [](const FieldArrow& arrow) { return arrow.vector.norm(); });
  for (const FieldArrow& arrow : sorted) {
    const Eigen::Vector2d half = kArrowShare * cell / scale / 2 * arrow.vector;
    overlay.strokes.push_back({arrow.center - half, arrow.center + half, width,
                               arrow_color(arrow.vector.norm() / scale), true});
  }
  return overlay;
}

}  // namespace clca::render
