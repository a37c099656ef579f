#pragma once
// Maps: cells, arrows and lines in the plane of the box, as SVG that stands in the page.

#include <string>
#include <vector>

namespace clca::report {

struct Cell {
  double x = 0;  ///< centre, lattice spacings
  double y = 0;
  double value = 0;  ///< NaN: not filled
  double dx = 0;     ///< arrow
  double dy = 0;
};

struct Line {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
  double weight = 0;  ///< the widest line has the largest
};

struct Map {
  std::string title = {};
  std::string value_title = {};  ///< what the fill of the cells means; empty: cells are not filled
  std::string arrow_title = {};  ///< unit of the arrows; empty: no arrows
  std::string line_title = {};   ///< unit of the weights
  double cell_width = 1;
  double cell_height = 1;
  std::vector<Cell> cells = {};
  std::vector<Line> lines = {};
};

/// The same with fewer, larger cells, means of those in them, where there are too many to draw.
Map coarsened(Map map);

/// Sets the size of a cell by the least distances between their centres.
void set_cell_size(Map& map);

/// Empty where there is nothing to draw.
std::string to_html(const Map& map);

}  // namespace clca::report
