#include "render/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clca/render/coloring.hpp"
#include "render/colors.hpp"
#include "render/legend_lines.hpp"
#include "render/marks.hpp"

namespace clca::render {

namespace {

// In text sizes, down from the lower edge of the view.
constexpr double kLegendMiddle = 1.1;
constexpr double kTickLabelBaseline = 2.55;
constexpr double kLegendPitch = 1.3;  // from line to line
// From the middle of a line of text down to its baseline.
constexpr double kHalfLetter = 0.36;
constexpr double kTitleSize = 1.2;
constexpr double kGap = 1.5;  // at least, between what stands on the left and on the right

}  // namespace

double round_length(double length) {
  const double decade = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= length) {
      return factor * decade;
    }
  }
  return decade;
}

std::vector<double> ticks(double low, double high, int count) {
  if (!(high > low) || !std::isfinite(high - low)) {
    return {low};
  }
  double step = round_length((high - low) / std::max(1, count - 1));
  if (std::floor(high / step) - std::ceil(low / step) + 1 > count) {
    step = round_length(2.5001 * step);
  }
  std::vector<double> result;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    result.push_back(i * step + 0.0);  // no minus zero
  }
  return result;
}

void Annotator::draw(Image& image, const Layout& layout, const Caption& caption,
                     const Legend& legend) {
  if (layout.text_size == 0) {
    return;
  }
  image_ = &image;
  layout_ = layout;
  draw_caption(caption);
  font_.set_size(layout.text_size);
  const double right = draw_scale_bar() - em(kGap);
  double left = layout.text_left;
  for (const Legend::Bar& bar : legend.bars) {
    left = draw_color_bar(bar, left, right) + em(kGap);
  }
  draw_patches(legend.patches, left, right);
}

void Annotator::draw_caption(const Caption& caption) {
  const double baseline = layout_.panel.y - em(0.8);
  const double room = layout_.text_right - layout_.text_left;
  font_.set_size(layout_.text_size);
  // The title gives way only as far as the detail needs no more than its half.
  const std::string detail =
      font_.shortened(caption.detail, caption.title.empty() ? room : std::max(room / 2, 0.0));
  const double detail_width = font_.width(detail);
  font_.draw(*image_, layout_.text_right - detail_width, baseline, detail, kPaleInk);
  // A title that does not fit becomes smaller before it is cut.
  const double title_room = detail.empty() ? room : room - detail_width - em(kGap);
  const double title_width = font_.width(caption.title);
  const double fitting = title_width > 0 ? 0.99 * title_room / title_width : kTitleSize;
  font_.set_size(std::clamp(fitting, 1.0, kTitleSize) * layout_.text_size);
  font_.draw(*image_, layout_.text_left, baseline, font_.shortened(caption.title, title_room),
             kInk);
}

double Annotator::draw_scale_bar() {
  const double room = layout_.text_right - layout_.text_left;
  const double length =
      round_length(std::min<double>(layout_.panel.width, room) / 5 / layout_.scale);
  const std::string label = fmt::format("{:g} {}", length, length == 1 ? "spacing" : "spacings");
  const double right = layout_.text_right;
  const double bar_left = right - length * layout_.scale;
  const double label_left = bar_left - em(0.7) - font_.width(label);
  if (label_left < layout_.text_left) {
    return right;
  }
  const double middle = below_panel(kLegendMiddle);
  const double thickness = std::max(1.0, std::round(em(0.12)));
  const double top = std::round(middle - thickness / 2);
  fill_box(*image_, bar_left, top, right, top + thickness, kInk);
  for (const double x : {bar_left, right - thickness}) {
    fill_box(*image_, x, middle - em(0.3), x + thickness, middle + em(0.3), kInk);
  }
  font_.draw(*image_, label_left, middle + em(kHalfLetter), label, kInk);
  return label_left;
}

double Annotator::draw_color_bar(const Legend::Bar& bar, double left, double right) {
  const int width = static_cast<int>(std::min(em(13), (right - left) * 0.6));
  if (width < em(4)) {
    return left;
  }
  const double top = std::round(below_panel(kLegendMiddle - 0.4));
  const double bottom = std::round(below_panel(kLegendMiddle + 0.4));
  for (int x = 0; x < width; ++x) {
    fill_box(*image_, left + x, top, left + x + 1, bottom, map_color((x + 0.5) / width));
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

void Annotator::draw_patches(const std::vector<Legend::Patch>& patches, double left, double right) {
  const double radius = em(0.52);
  const double label_place = 2 * radius + em(0.35);
  // The scale bar shortens the first line only.
  const std::array rooms = {right - left, layout_.text_right - left};
  std::vector<std::string> labels;
  std::vector<double> widths;
  for (const Legend::Patch& patch : patches) {
    labels.push_back(font_.shortened(patch.label, rooms.back() - label_place));
    widths.push_back(label_place + font_.width(labels.back()));
  }
  for (const LegendItem& item : legend_lines(widths, font_.width("…"), em(1.0), rooms)) {
    const double x = left + item.left;
    const double middle = below_panel(kLegendMiddle + kLegendPitch * item.line);
    const double baseline = middle + em(kHalfLetter);
    if (!item.entry) {
      font_.draw(*image_, x, baseline, "…", kInk);
      continue;
    }
    draw_hexagon(*image_, x + radius, middle, radius, std::max(1.0, em(0.09)),
                 patches[*item.entry].color);
    font_.draw(*image_, x + label_place, baseline, labels[*item.entry], kInk);
  }
}

}  // namespace clca::render
