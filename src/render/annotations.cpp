#include "render/annotations.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "clca/render/coloring.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

// In text sizes.
constexpr double kTitleSize = 1.2;
constexpr double kLegendMiddle = 1.1;  // down from the lower edge of the view
constexpr double kTickLabelBaseline = 2.55;
constexpr double kLegendPitch = 1.3;  // from line to line
constexpr double kHalfLetter = 0.36;  // from the middle of a line down to its baseline
constexpr double kBarWidth = 11;
constexpr double kGap = 1.5;  // at least, between what stands on the left and on the right
constexpr double kIconRadius = 0.52;
constexpr double kLineLength = 2.2;  // where the length tells nothing
constexpr double kMaxLineWidth = 0.9;
constexpr double kMaxArrowWidth = 0.27;  // the head is 3.4 times as wide as the shaft
constexpr double kBeforeLabel = 0.35;    // from the mark of an entry

std::vector<Eigen::Vector2d> hexagon() {
  std::vector<Eigen::Vector2d> corners;
  for (int corner = 0; corner < 6; ++corner) {
    const double angle = (corner + 0.5) * std::numbers::pi / 3;
    corners.emplace_back(std::cos(angle), std::sin(angle));
  }
  return corners;
}

/// `outline` (y upwards) about `middle` (y downwards), as large as fits into `radius`.
std::vector<Eigen::Vector2d> fitted(const std::vector<Eigen::Vector2d>& outline,
                                    const Eigen::Vector2d& middle, double radius) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : outline) {
    box.extend(corner);
  }
  const double scale = 2 * radius / box.sizes().maxCoeff();
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector2d& corner : outline) {
    const Eigen::Vector2d point = scale * (corner - box.center());
    result.emplace_back(middle.x() + point.x(), middle.y() - point.y());
  }
  return result;
}

struct Entry {
  Graphics::Text label;
  double mark_width = 0;  ///< pixels
  const Legend::Patch* patch = nullptr;
  std::optional<Stroke> stroke = {};
};

class Annotator {
 public:
  Annotator(Graphics& graphics, const Layout& layout) : graphics_(graphics), layout_(layout) {}

  void draw(const Caption& caption, const Legend& legend) {
    fade_ = legend.fade;
    if (layout_.has_captions) {
      draw_caption(caption);
    }
    const double bar_left = draw_scale_bar(caption.metres_per_spacing);
    const double right = bar_left - em(kGap);
    double left = layout_.text_left;
    for (const Legend::ColorBar& bar : legend.bars) {
      left = draw_color_bar(bar, left, right) + em(kGap);
    }
    draw_entries(legend, left, right);
  }

 private:
  double em(double text_sizes) const { return text_sizes * layout_.text_size; }
  double below_panel(double text_sizes) const {
    return layout_.panel.y + layout_.panel.height + em(text_sizes);
  }
  Graphics::Text text(const std::string& text,
                      double room = std::numeric_limits<double>::infinity()) {
    return graphics_.text(text, layout_.text_size, room);
  }

  void draw_caption(const Caption& caption) {
    const double baseline = layout_.panel.y - em(0.8);
    const double room = layout_.text_right - layout_.text_left;
    // The title is shortened only as far as the detail needs, up to half the width.
    const Graphics::Text detail =
        text(caption.detail, caption.title.empty() ? room : std::max(room / 2, 0.0));
    graphics_.draw_text(detail, layout_.text_right - detail.width(), baseline, kPaleInk);
    // A title that does not fit is first made smaller, then cut.
    const double title_room = detail.width() > 0 ? room - detail.width() - em(kGap) : room;
    const double width = text(caption.title).width();
    const double size = width > 0 ? std::clamp(0.99 * title_room / width, 1.0, kTitleSize) : 1;
    graphics_.draw_text(graphics_.text(caption.title, em(size), title_room), layout_.text_left,
                        baseline, kInk);
  }

  /// Returns its left end.
  double draw_scale_bar(double spacing) {
    if (!layout_.has_scale_bar) {
      return layout_.text_right + em(kGap);
    }
    const double room = layout_.text_right - layout_.text_left;
    const double unit = spacing > 0 ? spacing : 1;
    const double shown = largest_round_number_up_to(std::min<double>(layout_.panel.width, room) /
                                                    5 / layout_.pixels_per_spacing * unit);
    const double length = shown / unit;
    const LengthUnit metric = length_unit(shown);
    const Graphics::Text label =
        text(spacing > 0 ? fmt::format("{:g} {}", shown * metric.per_metre, metric.name)
                         : fmt::format("{:g} {}", length, length == 1 ? "spacing" : "spacings"));
    const double right = layout_.text_right;
    const double left = right - length * layout_.pixels_per_spacing;
    const double label_left = left - em(0.7) - label.width();
    if (label_left < layout_.text_left) {
      return right;
    }
    const double thickness = std::max(1.0, std::round(em(0.12)));
    const double top = std::round(below_panel(kLegendMiddle) - thickness / 2);
    const double end = std::round(em(0.3));
    graphics_.fill_box(left, top, right, top + thickness, kInk);
    for (const double x : {left, right - thickness}) {
      graphics_.fill_box(x, top - end, x + thickness, top + thickness + end, kInk);
    }
    graphics_.draw_text(label, label_left, below_panel(kLegendMiddle + kHalfLetter), kInk);
    return label_left;
  }

  /// Returns its right end.
  double draw_color_bar(const Legend::ColorBar& bar, double left, double right) {
    const double longest = em(kBarWidth);
    const double width = std::floor(std::min(longest, (right - left) * 0.6));
    if (width < em(4)) {
      return left;
    }
    const double top = std::round(below_panel(kLegendMiddle - 0.4));
    const double bottom = std::round(below_panel(kLegendMiddle + 0.4));
    const double tip = bottom - top;  // room for a mark of values beyond the end, there or not
    const double first = left + tip;
    const double last = left + width - tip;
    const int steps = bar.diverging ? 32 : 15;
    std::vector<Rgb> colors;
    for (int i = 0; i <= steps; ++i) {
      colors.push_back(mixed(bar_color(bar, static_cast<double>(i) / steps), kPaper, fade_));
    }
    graphics_.fill_gradient(first, top, last, bottom, colors);
    const double middle = (top + bottom) / 2;
    const auto draw_tip = [&](double from, double to, Rgb color) {
      const std::array<Eigen::Vector2d, 3> corners = {
          Eigen::Vector2d(from, top), Eigen::Vector2d(to, middle), Eigen::Vector2d(from, bottom)};
      graphics_.fill_polygon(corners, color, 1, kInk);
    };
    if (bar.below) {
      draw_tip(first, left, colors.front());
    }
    if (bar.above) {
      draw_tip(last, left + width, colors.back());
    }
    draw_ticks(bar, first, last - first, bottom);
    const double label_left = left + width + em(0.8);
    const Graphics::Text label = text(bar.label, right - label_left);
    graphics_.draw_text(label, label_left, below_panel(kLegendMiddle + kHalfLetter), kInk);
    return label_left + label.width();
  }

  void draw_ticks(const Legend::ColorBar& bar, double left, double width, double bottom) {
    struct Tick {
      double x;
      double label_left;
      Graphics::Text label;
    };
    const double thickness = std::max(1.0, std::round(em(0.07)));
    std::vector<Tick> shown;
    const auto have_room = [&] {
      return std::adjacent_find(shown.begin(), shown.end(), [&](const Tick& one, const Tick& next) {
               return one.label_left + one.label.width() + em(0.5) > next.label_left;
             }) == shown.end();
    };
    int most = 6;
    do {
      shown.clear();
      for (const double value : tick_values(bar.low, bar.high, most)) {
        const double share = bar.high > bar.low ? (value - bar.low) / (bar.high - bar.low) : 0;
        const double x = std::round(left + share * (width - thickness));
        const Graphics::Text label = text(fmt::format("{:g}", value));
        const double middle = x + thickness / 2 - label.width() / 2;
        shown.push_back({x, std::max<double>(layout_.text_left, middle), label});
      }
    } while (!have_room() && --most > 0);
    for (const Tick& tick : shown) {
      graphics_.fill_box(tick.x, bottom, tick.x + thickness, bottom + em(0.25), kInk);
      graphics_.draw_text(tick.label, tick.label_left, below_panel(kTickLabelBaseline), kInk);
    }
  }

  Stroke key_stroke(const Legend::Line& line) const {
    const double length =
        line.length > 0 ? line.length * layout_.pixels_per_spacing : em(kLineLength);
    const double width = std::min(line.width * layout_.pixels_per_spacing,
                                  em(line.arrow ? kMaxArrowWidth : kMaxLineWidth));
    return {{0, 0}, {length, 0}, width, line.color, line.arrow};
  }

  std::vector<Entry> entries_of(const Legend& legend, double room) {
    std::vector<Entry> entries;
    for (const Legend::Patch& patch : legend.patches) {
      const double width = 2 * em(kIconRadius);
      entries.push_back(
          {.label = text(patch.label, room - width), .mark_width = width, .patch = &patch});
    }
    for (const Legend::Line& line : legend.lines) {
      const Stroke stroke = key_stroke(line);
      entries.push_back({.label = text(line.label, room - stroke.to.x()),
                         .mark_width = stroke.to.x(),
                         .stroke = stroke});
    }
    return entries;
  }

  void draw_mark(const Entry& entry, double left, double middle) {
    if (entry.patch != nullptr) {
      static const std::vector<Eigen::Vector2d> kHexagon = hexagon();
      const Legend::Patch& patch = *entry.patch;
      const double radius = em(kIconRadius);
      const std::vector<Eigen::Vector2d> corners =
          fitted(patch.outline.empty() ? kHexagon : patch.outline, {left + radius, middle},
                 patch.size * radius);
      const Rgb color = mixed(patch.color, kPaper, fade_);
      graphics_.fill_polygon(corners, color, std::max(1.0, em(0.09)), outline_color(color, 1));
      return;
    }
    Stroke stroke = *entry.stroke;
    stroke.from = {left, middle};
    stroke.to = {left + entry.mark_width, middle};
    if (!stroke.is_arrow) {  // round ends stay within the mark
      const double end = std::min(stroke.width, entry.mark_width) / 2;
      stroke.from.x() += end;
      stroke.to.x() -= end;
    }
    graphics_.draw_stroke(stroke);
  }

  void draw_entries(const Legend& legend, double left, double right) {
    // The scale bar shortens the first line only.
    const std::array rooms = {right - left, layout_.text_right - left};
    const std::vector<Entry> entries = entries_of(legend, rooms.back() - em(kBeforeLabel));
    std::vector<double> widths;
    for (const Entry& entry : entries) {
      widths.push_back(entry.mark_width + em(kBeforeLabel) + entry.label.width());
    }
    const Graphics::Text ellipsis = text("…");
    for (const LegendItem& item : placed_legend_items(widths, ellipsis.width(), em(1.0), rooms)) {
      const double x = left + item.left;
      const double middle = below_panel(kLegendMiddle + kLegendPitch * item.line);
      const double baseline = middle + em(kHalfLetter);
      if (!item.entry_index) {
        graphics_.draw_text(ellipsis, x, baseline, kInk);
        continue;
      }
      const Entry& entry = entries[*item.entry_index];
      draw_mark(entry, x, middle);
      graphics_.draw_text(entry.label, x + entry.mark_width + em(kBeforeLabel), baseline, kInk);
    }
  }

  Graphics& graphics_;
  const Layout& layout_;
  double fade_ = 0;
};

}  // namespace

double largest_round_number_up_to(double number) {
  const double decade = std::pow(10.0, std::floor(std::log10(number)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= number) {
      return factor * decade;
    }
  }
  return decade;
}

std::vector<double> tick_values(double low, double high, int count) {
  if (!(high > low) || !std::isfinite(high - low)) {
    return {low};
  }
  double step = largest_round_number_up_to((high - low) / std::max(1, count - 1));
  if (std::floor(high / step) - std::ceil(low / step) + 1 > count) {
    step = largest_round_number_up_to(2.5001 * step);
  }
  std::vector<double> result;
  const auto most = static_cast<std::size_t>(std::max(1, count));  // reached where i + 1 is i
  for (double i = std::ceil(low / step - 1e-9);
       i * step <= high + 1e-9 * step && result.size() < most; ++i) {
    result.push_back(i * step + 0.0);  // no minus zero
  }
  return result;
}

std::vector<LegendItem> placed_legend_items(std::span<const double> widths, double ellipsis,
                                            double gap, std::span<const double> rooms) {
  std::vector<LegendItem> items;
  double left = 0;
  std::size_t line = 0;
  const auto add = [&](std::optional<std::size_t> entry) {
    const double width = entry ? widths[*entry] : ellipsis;
    for (; line < rooms.size() && left + width > rooms[line]; ++line) {
      left = 0;
    }
    if (line < rooms.size()) {
      items.push_back({entry, left, static_cast<int>(line)});
      left += width + gap;
    }
    return line < rooms.size();
  };
  const auto begin_with = [&](std::size_t count) {
    items.clear();
    left = 0;
    line = 0;
    std::size_t added = 0;
    while (added < count && add(added)) {
      ++added;
    }
    return added == count;
  };
  if (begin_with(widths.size())) {
    return items;
  }
  for (std::size_t kept = widths.size() - 1; kept-- > 0;) {
    if (begin_with(kept) && add({}) && add(widths.size() - 1)) {
      return items;
    }
  }
  begin_with(0);
  add({});
  return items;
}

LengthUnit length_unit(double metres) {
  return metres >= 1      ? LengthUnit{"m", 1}
         : metres >= 1e-3 ? LengthUnit{"mm", 1e3}
                          : LengthUnit{"µm", 1e6};
}

void annotate(Graphics& graphics, const Layout& layout, const Caption& caption,
              const Legend& legend) {
  if (layout.text_size > 0) {
    Annotator(graphics, layout).draw(caption, legend);
  }
}

}  // namespace clca::render
