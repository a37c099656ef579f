#include "render/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/render/coloring.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

// In text sizes, down from the lower edge of the view.
constexpr double kLegendMiddle = 1.25;
constexpr double kTickLabelBaseline = 2.65;
// From the middle of a line of text down to its baseline.
constexpr double kHalfLetter = 0.36;
constexpr double kTitleSize = 1.2;

int pixel(double place) {
  return static_cast<int>(std::lround(place));
}

void fill_box(Image& image, double left, double top, double right, double bottom, Rgb color) {
  const int last_x = std::min(std::max(pixel(right), pixel(left) + 1), image.width);
  const int last_y = std::min(std::max(pixel(bottom), pixel(top) + 1), image.height);
  for (int y = std::max(0, pixel(top)); y < last_y; ++y) {
    for (int x = std::max(0, pixel(left)); x < last_x; ++x) {
      image.at(x, y) = color;
    }
  }
}

/// Distance from the middle in the norm whose unit ball is a hexagon standing on a corner, of
/// circumradius 1: the form of particles.
double hexagonal_norm(double x, double y) {
  constexpr double kHalfRoot3 = 0.86602540378443864676;
  const double across = std::abs(x);
  return std::max(across, 0.5 * across + kHalfRoot3 * std::abs(y)) / kHalfRoot3;
}

/// One channel of a pixel of which `bare` and `dark` of `count` samples are paper and outline.
std::uint8_t mixed(std::uint8_t paper, std::uint8_t ink, std::uint8_t outline, int bare, int dark,
                   int count) {
  const int sum = paper * bare + outline * dark + ink * (count - bare - dark);
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

void draw_hexagon_pixel(Rgb& pixel, double dx, double dy, double radius, double outline,
                        Rgb color) {
  constexpr int kSide = 4;
  constexpr int kCount = kSide * kSide;
  int bare = 0;
  int dark = 0;
  for (int sample = 0; sample < kCount; ++sample) {
    const double norm = hexagonal_norm(dx + (sample % kSide + 0.5) / kSide,
                                       dy + (static_cast<int>(sample / kSide) + 0.5) / kSide);
    bare += norm > radius ? 1 : 0;
    dark += norm <= radius && norm > radius - outline ? 1 : 0;
  }
  const Rgb edge = outline_color(color);
  pixel = {mixed(pixel.red, color.red, edge.red, bare, dark, kCount),
           mixed(pixel.green, color.green, edge.green, bare, dark, kCount),
           mixed(pixel.blue, color.blue, edge.blue, bare, dark, kCount)};
}

void draw_hexagon(Image& image, double x, double y, double radius, double outline, Rgb color) {
  const int reach = static_cast<int>(radius) + 2;
  const int last_x = std::min(image.width, pixel(x) + reach);
  const int last_y = std::min(image.height, pixel(y) + reach);
  for (int row = std::max(0, pixel(y) - reach); row < last_y; ++row) {
    for (int column = std::max(0, pixel(x) - reach); column < last_x; ++column) {
      draw_hexagon_pixel(image.at(column, row), column - x, row - y, radius, outline, color);
    }
  }
}

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
  const double right = draw_scale_bar() - em(1.5);
  double left = layout.text_left;
  for (const Legend::Bar& bar : legend.bars) {
    left = draw_color_bar(bar, left, right) + em(1.5);
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
  font_.set_size(kTitleSize * layout_.text_size);
  const double title_room = detail.empty() ? room : room - detail_width - em(1.5);
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
  const double width = std::floor(std::min(em(13), (right - left) * 0.6));
  if (width < em(4)) {
    return left;
  }
  const double top = std::round(below_panel(kLegendMiddle - 0.4));
  const double bottom = std::round(below_panel(kLegendMiddle + 0.4));
  for (double x = 0; x < width; ++x) {
    fill_box(*image_, left + x, top, left + x + 1, bottom, map_color((x + 0.5) / width));
  }
  const double stroke = std::max(1.0, std::round(em(0.07)));
  double label_end = -INFINITY;
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
  const double middle = below_panel(kLegendMiddle);
  const double baseline = middle + em(kHalfLetter);
  const double radius = em(0.52);
  const double ellipsis = font_.width("…");
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const double label_left = left + 2 * radius + em(0.35);
    const double end = label_left + font_.width(patches[i].label);
    const double reserve = i + 1 < patches.size() ? em(1.0) + ellipsis : 0;
    if (end + reserve > right) {
      if (left + ellipsis <= right) {
        font_.draw(*image_, left, baseline, "…", kInk);
      }
      return;
    }
    draw_hexagon(*image_, left + radius, middle, radius, std::max(1.0, em(0.09)), patches[i].color);
    font_.draw(*image_, label_left, baseline, patches[i].label, kInk);
    left = end + em(1.0);
  }
}

}  // namespace clca::render
