#pragma once
// The legend of a picture.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// Named icons with colours, a colour bar, and lines or arrows as in the overlay.
struct Legend {
  struct Patch {
    std::string label;
    Rgb color = {};
    std::vector<Eigen::Vector2d> outline = {};  ///< of the icon, y upwards; empty: a hexagon
    double size = 1;                            ///< of the icon, as a share of the largest

    bool operator==(const Patch&) const = default;
  };
  struct ColorBar {
    std::string label;  ///< with the unit
    double low = 0;
    double high = 1;
    bool diverging = false;  ///< colours to both sides of 0
    bool below = false;      ///< some values lie below `low`: marked at the end of the bar
    bool above = false;

    bool operator==(const ColorBar&) const = default;
  };
  struct Line {
    std::string label;
    double width = 0.5;  ///< lattice spacings; drawn no thicker than a line of text
    double length = 0;   ///< lattice spacings; 0: without meaning
    Rgb color = {};
    bool arrow = false;

    bool operator==(const Line&) const = default;
  };
  std::vector<Patch> patches;
  std::vector<ColorBar> bars;  ///< none or one
  std::vector<Line> lines;
  double fade = 0;  ///< of the colours of icons and bars, as Overlay::fade

  bool operator==(const Legend&) const = default;
};

/// Adds an entry for standing walls, which floor and sides of the box are, too, and, if `moving`,
/// one for moving walls.
void add_wall_entries(Legend& legend, bool moving);

/// The legend of two pictures: what both have and what one has. None where lines differ, or colour
/// bars by more than the marks.
std::optional<Legend> common_legend(const Legend& first, const Legend& second);

/// The legend as JSON, for the metadata of pictures.
std::string to_text(const Legend& legend);
/// The legend in a text of to_text(); an empty one for other text.
Legend parse_legend(const std::string& text);

/// The largest of 1, 2 and 5 times a power of ten not above a positive number.
double largest_round_number_up_to(double number);

struct LengthUnit {
  const char* name = "";
  double per_metre = 1;  ///< units in a metre
};
/// The largest of m, mm and µm in which the length is at least 1.
LengthUnit length_unit(double metres);

}  // namespace clca::render
