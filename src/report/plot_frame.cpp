#include "report/plot_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/text.hpp"

namespace clca::report {

namespace {

/// Of a text in UTF-8.
bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::string times_power(const Axis& axis) {
  return axis.exponent() == 0 ? "" : "× " + power_of_ten(axis.exponent());
}

/// Every how many ticks there is room for a label, in the large letters of a narrow page.
std::size_t labels_apart(const Axis& axis, double width) {
  constexpr double kLetter = 12;
  std::size_t longest = 0;
  for (const double tick : axis.ticks()) {
    const std::string label = axis.label(tick);
    longest = std::max(longest, static_cast<std::size_t>(
                                    std::count_if(label.begin(), label.end(), begins_letter)));
  }
  const double room = width / static_cast<double>(std::max<std::size_t>(axis.ticks().size(), 1));
  return static_cast<std::size_t>(std::ceil(kLetter * static_cast<double>(longest + 1) / room));
}

}  // namespace

PlotFrame PlotFrame::with_equal_scales(Axis x, Axis y, double most_height) {
  constexpr double kLeast = 110;
  PlotFrame frame(std::move(x), std::move(y));
  const double ratio = (frame.y_.high() - frame.y_.low()) / (frame.x_.high() - frame.x_.low());
  frame.height_ = std::clamp(frame.width_ * ratio, kLeast, most_height);
  frame.width_ = std::clamp(frame.height_ / ratio, kLeast, frame.width_);
  return frame;
}

double PlotFrame::y_of(double value) const {
  const double least = y_.is_logarithmic() ? std::max(value, y_.low()) : value;
  return bottom() - height_ * std::clamp(y_.part(least), 0.0, 1.0);
}

std::string PlotFrame::axes(std::string_view x_title) const {
  constexpr double kLeastTitle = 240;  // room for the title of a narrow picture
  std::string svg;
  for (const double tick : y_.ticks()) {
    const double y = y_of(tick);
    svg += fmt::format(
        R"(<path class="grid" d="M{:.1f} {:.1f}H{:.1f}"/><text class="up" x="{:.1f}" y="{:.1f}">{}</text>)",
        left(), y, right(), left() - 9, y, y_.label(tick));
  }
  const std::size_t every = labels_apart(x_, width_);
  for (std::size_t i = 0; i < x_.ticks().size(); ++i) {
    const double tick = x_.ticks()[i];
    const double x = x_of(tick);
    svg += fmt::format(
        R"(<path class="axis" d="M{:.1f} {:.1f}v5"/><text class="across" x="{:.1f}" y="{:.1f}">{}</text>)",
        x, bottom(), x, bottom() + 20, i % every == 0 ? x_.label(tick) : "");
  }
  svg +=
      fmt::format(R"(<path class="axis" d="M{:.1f} {:.1f}H{:.1f}"/>)", left(), bottom(), right());
  svg += fmt::format(R"(<text class="title" x="{:.1f}" y="{:.1f}">{} {}</text>)",
                     std::max(right(), left() + kLeastTitle), bottom() + 43, escaped(x_title),
                     times_power(x_));
  if (y_.exponent() != 0) {
    svg += fmt::format(R"(<text class="power" x="{:.1f}" y="12">{}</text>)", left() - 9,
                       times_power(y_));
  }
  return svg;
}

std::string PlotFrame::view_box() const {
  return fmt::format("0 0 {:.0f} {:.0f}", kWidth, bottom() + kBottom);
}

}  // namespace clca::report
