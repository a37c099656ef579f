#pragma once
// Charts as SVG that stands in the page.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clca::report {

struct Curve {
  std::string name;  ///< in the legend; empty: not there, as one of a family with one name
  std::vector<double> x;
  std::vector<double> y;       ///< as many; NaN where there is nothing
  std::vector<double> spread;  ///< half the height of a band around it, or empty
  bool is_reference = false;   ///< dashed: what the other curves are held to
  bool is_steps = false;       ///< each value holds until the next x
  bool is_dots = false;        ///< not joined
  int color = -1;              ///< number of the curve whose colour it has; -1: its own
};

struct Chart {
  std::string title;    ///< what is drawn upwards, with its unit
  std::string x_title;  ///< with its unit
  std::vector<Curve> curves;
  bool is_logarithmic = false;  ///< upwards
  bool has_equal_scales = false;
  bool begins_at_zero = false;  ///< upwards, where no value is below
};

/// Whether there is a point to draw.
bool is_drawable(const Chart& chart);

/// A figure with heading, legend and, as data for the script of the page, the points that are
/// drawn: 1000 for each curve at the most. `number` makes its ids differ from those of others.
std::string to_html(const Chart& chart, std::size_t number);

/// Attributes that give an element the colour of a curve of `count`, with the class `also`.
std::string color_attributes(std::size_t curve, std::size_t count, std::string_view also);

}  // namespace clca::report
