#include "report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/decimate.hpp"
#include "report/plot_frame.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMostPoints = 1000;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool is_empty() const { return low > high; }
};

bool is_shown(const Chart& chart, const Curve& curve, std::size_t row) {
  return std::isfinite(curve.x[row]) && std::isfinite(curve.y[row]) &&
         (!chart.is_logarithmic || curve.y[row] > 0);
}

/// Of all points that can be drawn.
std::pair<Range, Range> ranges(const Chart& chart) {
  Range x;
  Range y;
  for (const Curve& curve : chart.curves) {
    for (std::size_t row = 0; row < curve.x.size(); ++row) {
      if (is_shown(chart, curve, row)) {
        x.add(curve.x[row]);
        y.add(curve.y[row]);
      }
    }
  }
  return {x, y};
}

PlotFrame frame_of(const Chart& chart) {
  constexpr double kMostHeight = 420;
  const auto [across, upwards] = ranges(chart);
  const Axis x = Axis::linear(across.low, across.high, false);
  if (chart.is_logarithmic) {
    return {x, Axis::logarithmic(upwards.low, upwards.high)};
  }
  const bool from_zero = chart.begins_at_zero && upwards.low > 0;
  const Axis y = Axis::linear(from_zero ? 0 : upwards.low, upwards.high, true);
  return chart.has_equal_scales ? PlotFrame::with_equal_scales(x, y, kMostHeight) : PlotFrame(x, y);
}

/// The rows of a curve that are drawn.
std::vector<std::size_t> drawn_rows(const Chart& chart, const Curve& curve) {
  std::vector<double> shown = curve.y;
  for (std::size_t row = 0; row < shown.size(); ++row) {
    if (!is_shown(chart, curve, row)) {
      shown[row] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return kept_rows(shown, kMostPoints);
}

/// A point that stands alone becomes a dot, by the round ends of lines.
std::string line_path(const Chart& chart, const Curve& curve, const PlotFrame& frame,
                      const std::vector<std::size_t>& rows) {
  std::string path;
  bool goes_on = false;
  for (const std::size_t row : rows) {
    if (!is_shown(chart, curve, row)) {
      goes_on = false;
      continue;
    }
    const double x = frame.x_of(curve.x[row]);
    const double y = frame.y_of(curve.y[row]);
    if (!goes_on || curve.is_dots) {
      path += fmt::format("M{:.1f} {:.1f}h0", x, y);
    } else if (curve.is_steps) {
      path += fmt::format("H{:.1f}V{:.1f}", x, y);
    } else {
      path += fmt::format("L{:.1f} {:.1f}", x, y);
    }
    goes_on = true;
  }
  return path;
}

/// Up along one edge and back along the other.
std::string band_path(const Chart& chart, const Curve& curve, const PlotFrame& frame,
                      const std::vector<std::size_t>& rows) {
  std::string there;
  std::string back;
  for (const std::size_t row : rows) {
    if (is_shown(chart, curve, row) && std::isfinite(curve.spread[row])) {
      const double x = frame.x_of(curve.x[row]);
      there += fmt::format("{}{:.1f} {:.1f}", there.empty() ? "M" : "L", x,
                           frame.y_of(curve.y[row] + curve.spread[row]));
      back.insert(0,
                  fmt::format("L{:.1f} {:.1f}", x, frame.y_of(curve.y[row] - curve.spread[row])));
    }
  }
  return there.empty() ? there : there + back + "Z";
}

std::size_t color_of(const Chart& chart, std::size_t curve) {
  const int other = chart.curves[curve].color;
  return other >= 0 ? static_cast<std::size_t>(other) : curve;
}

/// Curves with colours of their own.
std::size_t color_count(const Chart& chart) {
  return static_cast<std::size_t>(
      std::count_if(chart.curves.begin(), chart.curves.end(),
                    [](const Curve& curve) { return curve.color < 0 && !curve.is_reference; }));
}

/// A reference without a curve of its own is drawn in the colour of text.
std::string curve_attributes(const Chart& chart, std::size_t number) {
  const Curve& curve = chart.curves[number];
  return curve.is_reference && curve.color < 0
             ? R"(class="plain reference")"
             : color_attributes(color_of(chart, number), color_count(chart),
                                curve.is_reference ? "reference" : "");
}

std::string curves_svg(const Chart& chart, const PlotFrame& frame) {
  std::string svg;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    const auto rows = drawn_rows(chart, curve);
    if (!curve.spread.empty()) {
      svg += fmt::format(R"(<g {}><path class="band" d="{}"/></g>)", curve_attributes(chart, i),
                         band_path(chart, curve, frame, rows));
    }
    svg += fmt::format(R"(<g {}><path class="{}" d="{}"/></g>)", curve_attributes(chart, i),
                       curve.is_dots ? "dots" : "curve", line_path(chart, curve, frame, rows));
  }
  return svg;
}

/// For the script of the page, which shows values where the pointer is.
std::string data_json(const Chart& chart, const PlotFrame& frame) {
  using Json = nlohmann::json;
  Json curves = Json::array();
  for (const Curve& curve : chart.curves) {
    Json points = Json::array();
    for (const std::size_t row : drawn_rows(chart, curve)) {
      if (is_shown(chart, curve, row)) {
        points.push_back({std::round(10 * frame.x_of(curve.x[row])) / 10, brief(curve.x[row]),
                          brief(curve.y[row])});
      }
    }
    curves.push_back(std::move(points));
  }
  return Json({{"left", PlotFrame::left()},
               {"right", std::round(frame.right())},
               {"top", PlotFrame::top()},
               {"bottom", std::round(frame.bottom())},
               {"curves", std::move(curves)}})
      .dump();
}

std::string legend_html(const Chart& chart) {
  std::string items;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    if (chart.curves[i].name.empty()) {
      continue;
    }
    items += fmt::format(
        R"(<li><svg class="key" viewBox="0 0 24 10" aria-hidden="true"><g {}><path class="curve" d="M2 5H22"/></g></svg>)"
        R"(<span>{}</span> <output data-curve="{}"></output></li>)",
        curve_attributes(chart, i), escaped(chart.curves[i].name), i);
  }
  return fmt::format(R"(<ul class="legend">{}</ul>)", items);
}

/// In words, for those who do not see it.
std::string described(const Chart& chart) {
  const auto [x, y] = ranges(chart);
  return fmt::format("{}, from {} to {}, over {} from {} to {}; {} {}", chart.title, brief(y.low),
                     brief(y.high), chart.x_title, brief(x.low), brief(x.high), chart.curves.size(),
                     chart.curves.size() == 1 ? "curve" : "curves");
}

}  // namespace

bool is_drawable(const Chart& chart) {
  return !ranges(chart).first.is_empty();
}

std::string color_attributes(std::size_t curve, std::size_t count, std::string_view also) {
  constexpr std::size_t kClasses = 7;
  if (count <= kClasses) {
    return fmt::format(R"(class="c{}{}{}")", curve, also.empty() ? "" : " ", also);
  }
  // Hues from blue to red, neither too dark for a black page nor too light for a white one.
  const double part = static_cast<double>(curve) / static_cast<double>(count - 1);
  return fmt::format(R"html(class="own{}{}" style="--own: hsl({:.0f} 62% 48%)")html",
                     also.empty() ? "" : " ", also, 255 - 245 * part);
}

std::string to_html(const Chart& chart, std::size_t number) {
  const PlotFrame frame = frame_of(chart);
  return fmt::format(
      R"(<figure class="chart" id="chart-{0}"><h3>{1}</h3>{2}<svg viewBox="{3}" role="img" aria-label="{4}">{5}{6}<path class="cursor" d=""/></svg><script type="application/json">{7}</script></figure>
)",
      number, escaped(chart.title), legend_html(chart), frame.view_box(), escaped(described(chart)),
      frame.axes(chart.x_title), curves_svg(chart, frame), data_json(chart, frame));
}

}  // namespace clca::report
