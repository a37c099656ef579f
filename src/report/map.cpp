#include "report/map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "report/plot_frame.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMostCells = 4000;
constexpr double kMostMapHeight = 520;

bool is_sound(const Cell& cell) {
  return std::isfinite(cell.x) && std::isfinite(cell.y) && std::isfinite(cell.dx) &&
         std::isfinite(cell.dy);
}

double least_gap(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double gap = places[i] - places[i - 1];
    least = gap > 1e-6 ? std::min(least, gap) : least;
  }
  return std::isfinite(least) ? least : 1;
}

/// From the left or lower end of everything to the other.
struct Extent {
  double left = std::numeric_limits<double>::infinity();
  double bottom = left;
  double right = -left;
  double top = -left;

  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
};

Extent extent(const Map& map) {
  Extent all;
  for (const Cell& cell : map.cells) {
    all.add(cell.x - map.cell_width / 2, cell.y - map.cell_height / 2);
    all.add(cell.x + map.cell_width / 2, cell.y + map.cell_height / 2);
  }
  for (const Line& line : map.lines) {
    all.add(line.x0, line.y0);
    all.add(line.x1, line.y1);
  }
  return all;
}

/// Length of an arrow that goes as far as the next cell: nine of ten are shorter, so that a few
/// fast cells do not make dots of all others.
double usual_arrow(const Map& map) {
  std::vector<double> lengths;
  for (const Cell& cell : map.cells) {
    const double length = std::hypot(cell.dx, cell.dy);
    if (length > 0) {
      lengths.push_back(length);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths.empty() ? 0 : lengths[(lengths.size() - 1) * 9 / 10];
}

double largest_value(const Map& map) {
  double largest = 0;
  for (const Cell& cell : map.cells) {
    largest = std::isfinite(cell.value) ? std::max(largest, cell.value) : largest;
  }
  return largest;
}

double largest_weight(const Map& map) {
  double largest = 0;
  for (const Line& line : map.lines) {
    largest = std::max(largest, line.weight);
  }
  return largest;
}

std::string fills(const Map& map, const PlotFrame& frame) {
  const double largest = largest_value(map);
  if (map.value_title.empty() || largest <= 0) {
    return {};
  }
  std::string svg = R"(<g class="cells">)";
  for (const Cell& cell : map.cells) {
    if (std::isfinite(cell.value)) {
      svg += fmt::format(
          R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill-opacity="{:.2f}"/>)",
          frame.x_of(cell.x - map.cell_width / 2), frame.y_of(cell.y + map.cell_height / 2),
          map.cell_width * frame.scale(), map.cell_height * frame.scale(),
          std::clamp(cell.value / largest, 0.0, 1.0));
    }
  }
  return svg + "</g>";
}

/// From the centre of its cell on.
std::string arrows(const Map& map, const PlotFrame& frame) {
  const double usual = usual_arrow(map);
  if (map.arrow_title.empty() || usual <= 0) {
    return {};
  }
  const double cell_length = std::min(map.cell_width, map.cell_height) * frame.scale();
  constexpr double kLongest = 1.3;      // cells
  constexpr double kLeastLength = 0.7;  // else there is nothing to be seen
  std::string path;
  for (const Cell& cell : map.cells) {
    const double part = std::hypot(cell.dx, cell.dy) / usual;
    const double unit = std::min(1.0, kLongest / part) * cell_length / usual;
    const double across = unit * cell.dx;
    const double down = -unit * cell.dy;
    const double length = std::hypot(across, down);
    if (!(length > kLeastLength)) {
      continue;
    }
    const double head = std::min(4.0, length / 2) / length;
    path += fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}", frame.x_of(cell.x), frame.y_of(cell.y),
                        across, down);
    path += fmt::format("m{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}", head * (-across - 0.6 * down),
                        head * (-down + 0.6 * across), head * (across + 0.6 * down),
                        head * (down - 0.6 * across), head * (-across + 0.6 * down),
                        head * (-down - 0.6 * across));
  }
  return fmt::format(R"(<path class="arrows" d="{}"/>)", path);
}

std::string lines(const Map& map, const PlotFrame& frame) {
  constexpr double kLeastWidth = 0.8;
  constexpr double kMostWidth = 6;
  const double largest = largest_weight(map);
  std::string svg = R"(<g class="lines">)";
  for (const Line& line : map.lines) {
    svg +=
        fmt::format(R"(<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke-width="{:.1f}"/>)",
                    frame.x_of(line.x0), frame.y_of(line.y0), frame.x_of(line.x1),
                    frame.y_of(line.y1), std::max(kLeastWidth, kMostWidth * line.weight / largest));
  }
  return svg + "</g>";
}

std::string key_html(const Map& map) {
  std::string items;
  if (!map.value_title.empty()) {
    items += fmt::format(R"(<li>{} <span class="ramp">0<i aria-hidden="true"></i>{}</span></li>)",
                         escaped(map.value_title), brief(largest_value(map)));
  }
  if (!map.arrow_title.empty()) {
    items += fmt::format("<li>arrow over a cell: {} {}; cut at 1.3 cells</li>",
                         brief(usual_arrow(map)), escaped(map.arrow_title));
  }
  if (!map.line_title.empty()) {
    items += fmt::format("<li>{} lines; the widest: {} {}</li>", whole(map.lines.size()),
                         brief(largest_weight(map)), escaped(map.line_title));
  }
  return fmt::format(R"(<ul class="legend">{}</ul>)", items);
}

}  // namespace

void set_cell_size(Map& map) {
  std::vector<double> across;
  std::vector<double> upwards;
  for (const Cell& cell : map.cells) {
    across.push_back(cell.x);
    upwards.push_back(cell.y);
  }
  map.cell_width = least_gap(std::move(across));
  map.cell_height = least_gap(std::move(upwards));
}

Map coarsened(Map map) {
  std::erase_if(map.cells, [](const Cell& cell) { return !is_sound(cell); });
  if (map.cells.size() <= kMostCells) {
    return map;
  }
  const double factor =
      std::ceil(std::sqrt(static_cast<double>(map.cells.size()) / static_cast<double>(kMostCells)));
  const Extent all = extent(map);
  map.cell_width = std::max(map.cell_width * factor, (all.right - all.left) / kMostCells);
  map.cell_height = std::max(map.cell_height * factor, (all.top - all.bottom) / kMostCells);
  struct Sum {
    Cell cell;
    double count = 0;
  };
  std::map<std::pair<double, double>, Sum> sums;
  for (const Cell& cell : map.cells) {
    const double column = std::floor((cell.x - all.left) / map.cell_width);
    const double row = std::floor((cell.y - all.bottom) / map.cell_height);
    Sum& sum = sums[{column, row}];
    sum.cell.x = all.left + (column + 0.5) * map.cell_width;
    sum.cell.y = all.bottom + (row + 0.5) * map.cell_height;
    sum.cell.value += cell.value;
    sum.cell.dx += cell.dx;
    sum.cell.dy += cell.dy;
    ++sum.count;
  }
  map.cells.clear();
  for (auto& [place, sum] : sums) {
    sum.cell.value /= sum.count;
    sum.cell.dx /= sum.count;
    sum.cell.dy /= sum.count;
    map.cells.push_back(sum.cell);
  }
  map.cells.resize(std::min(map.cells.size(), 2 * kMostCells));
  return map;
}

std::string to_html(const Map& map) {
  if (map.cells.empty() && map.lines.empty()) {
    return {};
  }
  const Extent all = extent(map);
  const PlotFrame frame = PlotFrame::with_equal_scales(
      Axis::linear(all.left, all.right, false),
      Axis::linear(std::min(all.bottom, 0.0), all.top, false), kMostMapHeight);
  return fmt::format(
      R"(<figure class="map"><h3>{}</h3>{}<svg viewBox="{}" role="img" aria-label="{}">{}{}{}{}</svg></figure>
)",
      escaped(map.title), key_html(map), frame.view_box(), escaped(map.title),
      frame.axes("x, lattice spacings; upwards y"), fills(map, frame), arrows(map, frame),
      lines(map, frame));
}

}  // namespace clca::report
