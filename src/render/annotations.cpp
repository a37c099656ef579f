#include "render/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/colors.hpp"
#include "render/marks.hpp"

namespace clca::render {

namespace {

constexpr double kTitleSize = 1.2;  // in text sizes

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
                     const Legend& legend, double fade) {
  if (layout.text_size == 0) {
    return;
  }
  image_ = &image;
  layout_ = layout;
  fade_ = fade;
  draw_caption(caption);
  font_.set_size(layout.text_size);
  const double right = draw_scale_bar(caption.spacing) - em(kGap);
  double left = layout.text_left;
  for (const Legend::Bar& bar : legend.bars) {
    left = draw_color_bar(bar, left, right) + em(kGap);
  }
  draw_entries(legend, left, right);
}

void Annotator::draw_caption(const Caption& caption) {
  const double baseline = layout_.panel.y - em(0.8);
  const double room = layout_.text_right - layout_.text_left;
  font_.set_size(layout_.text_size);
  // The title is shortened only as far as the detail needs, up to half the width.
  const std::string detail =
      font_.shortened(caption.detail, caption.title.empty() ? room : std::max(room / 2, 0.0));
  const double detail_width = font_.width(detail);
  font_.draw(*image_, layout_.text_right - detail_width, baseline, detail, kPaleInk);
  // A title that does not fit is first made smaller, then cut.
  const double title_room = detail.empty() ? room : room - detail_width - em(kGap);
  const double title_width = font_.width(caption.title);
  const double fitting = title_width > 0 ? 0.99 * title_room / title_width : kTitleSize;
  font_.set_size(std::clamp(fitting, 1.0, kTitleSize) * layout_.text_size);
  font_.draw(*image_, layout_.text_left, baseline, font_.shortened(caption.title, title_room),
             kInk);
}

std::string metres_text(double length) {
  return length >= 1      ? fmt::format("{:g} m", length)
         : length >= 1e-3 ? fmt::format("{:g} mm", length * 1e3)
                          : fmt::format("{:g} µm", length * 1e6);
}

double Annotator::draw_scale_bar(double spacing) {
  const double room = layout_.text_right - layout_.text_left;
  const double unit = spacing > 0 ? spacing : 1;
  const double shown =
      round_length(std::min<double>(layout_.panel.width, room) / 5 / layout_.scale * unit);
  const double length = shown / unit;
  const std::string label =
      spacing > 0 ? metres_text(shown)
                  : fmt::format("{:g} {}", length, length == 1 ? "spacing" : "spacings");
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

}  // namespace clca::render
