#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "clca/render/coloring.hpp"
#include "render/annotations.hpp"
#include "render/blend.hpp"
#include "render/colors.hpp"
#include "render/legend_lines.hpp"
#include "render/marks.hpp"
#include "render/strokes.hpp"

namespace clca::render {

namespace {

// In text sizes.
constexpr double kTickLabelBaseline = 2.55;  // down from the lower edge of the view
constexpr double kLegendPitch = 1.3;         // from line to line
constexpr double kPatchRadius = 0.52;
constexpr double kLineLength = 2.2;  // where the length tells nothing
constexpr double kMaxLineWidth = 0.9;
constexpr double kBeforeLabel = 0.35;

}  // namespace

double Annotator::draw_color_bar(const Legend::Bar& bar, double left, double right) {
  const int width = static_cast<int>(std::min(em(13), (right - left) * 0.6));
  if (width < em(4)) {
    return left;
  }
  const double top = std::round(below_panel(kLegendMiddle - 0.4));
  const double bottom = std::round(below_panel(kLegendMiddle + 0.4));
  for (int x = 0; x < width; ++x) {
    fill_box(*image_, left + x, top, left + x + 1, bottom,
             faded(map_color((x + 0.5) / width), fade_));
  }
  const double stroke = std::max(1.0, std::round(em(0.07)));
  double label_end = -std::numeric_limits<double>::infinity();
  for (const double value : ticks(bar.low, bar.high, 6)) {
    const double share = bar.high > bar.low ? (value - bar.low) / (bar.high - bar.low) : 0;
    const double x = left + share * (width - stroke);
    fill_box(*image_, x, bottom, x + stroke, bottom + em(0.25), kInk);
    const std::string label = fmt::format("{:g}", value);
    const double label_width = font_.width(label);
    const double label_left = std::max<double>(layout_.text_left, x - label_width / 2);
    if (label_left > label_end + em(0.5)) {
      font_.draw(*image_, label_left, below_panel(kTickLabelBaseline), label, kInk);
      label_end = label_left + label_width;
    }
  }
  const double label_left = left + width + em(0.8);
  const std::string label = font_.shortened(bar.label, right - label_left);
  font_.draw(*image_, label_left, below_panel(kLegendMiddle + kHalfLetter), label, kInk);
  return label_left + font_.width(label);
}

Stroke Annotator::key_stroke(const Legend::Line& line) const {
  const double length = line.length > 0 ? line.length * layout_.scale : em(kLineLength);
  const double width = std::min(line.width * layout_.scale, em(kMaxLineWidth));
  return {{0, 0}, {length, 0}, width, line.color, line.arrow};
}

std::vector<Annotator::Entry> Annotator::entries_of(const Legend& legend) const {
  std::vector<Entry> entries;
  for (const Legend::Patch& patch : legend.patches) {
    const Rgb color = faded(patch.color, fade_);
    entries.push_back({.label = patch.label, .mark_width = 2 * em(kPatchRadius), .color = color});
  }
  for (const Legend::Line& line : legend.lines) {
    const Stroke stroke = key_stroke(line);
    entries.push_back({.label = line.label, .mark_width = stroke.to.x(), .stroke = stroke});
  }
  return entries;
}

void Annotator::draw_mark(const Entry& entry, double left, double middle) {
  if (!entry.stroke) {
    const double radius = em(kPatchRadius);
    draw_hexagon(*image_, left + radius, middle, radius, std::max(1.0, em(0.09)), entry.color);
    return;
  }
  Stroke stroke = *entry.stroke;
  stroke.from = {left, middle};
  stroke.to = {left + entry.mark_width, middle};
  if (!stroke.arrow) {  // round ends stay within the mark
    const double end = std::min(stroke.width, entry.mark_width) / 2;
    stroke.from.x() += end;
    stroke.to.x() -= end;
  }
  draw_stroke(*image_, stroke);
}

void Annotator::draw_entries(const Legend& legend, double left, double right) {
  // The scale bar shortens the first line only.
  const std::array rooms = {right - left, layout_.text_right - left};
  std::vector<Entry> entries = entries_of(legend);
  std::vector<double> widths;
  for (Entry& entry : entries) {
    const double label_place = entry.mark_width + em(kBeforeLabel);
    entry.label = font_.shortened(entry.label, rooms.back() - label_place);
    widths.push_back(label_place + font_.width(entry.label));
  }
  for (const LegendItem& item : legend_lines(widths, font_.width("…"), em(1.0), rooms)) {
    const double x = left + item.left;
    const double middle = below_panel(kLegendMiddle + kLegendPitch * item.line);
    const double baseline = middle + em(kHalfLetter);
    if (!item.entry) {
      font_.draw(*image_, x, baseline, "…", kInk);
      continue;
    }
    const Entry& entry = entries[*item.entry];
    draw_mark(entry, x, middle);
    font_.draw(*image_, x + entry.mark_width + em(kBeforeLabel), baseline, entry.label, kInk);
  }
}

}  // namespace clca::render
