#pragma once
// Lines and arrows drawn over the particles of a picture: force networks and vector fields.

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "clca/render/image.hpp"
#include "clca/render/legend.hpp"

namespace clca::render {

/// A straight line with round ends; lattice spacings. An arrow has its head at `to`; one shorter
/// than its width or a pixel is drawn as a dot. Arrows are drawn whole: those that would cross the
/// edge of the view are moved into it, those with their middle outside are left out.
struct Stroke {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double width = 0.5;
  Rgb color = {};
  bool is_arrow = false;
};

struct Overlay {
  std::vector<Stroke> strokes;  ///< later ones lie on top
  double fade = 0;              ///< 0 to 1: how far everything below is faded to white
  std::vector<Legend::Line> legend_lines = {};  ///< what the strokes mean
};

/// A contact that carries force, between two points in lattice spacings.
struct ForceLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double strength = 0;
};

/// Lines with widths by strength, widest at `strongest`, stronger lines on top. Lines of zero
/// strength are left out. The legend line is that of a contact of strength `strongest`.
Overlay force_network(std::span<const ForceLine> lines, double strongest, std::string label);

/// A vector at the centre of a cell (lattice spacings), in any unit.
struct FieldArrow {
  Eigen::Vector2d center;
  Eigen::Vector2d vector;
};

/// A scale for arrow_field(): a round number up to 1.5 times the mean length of the arrows,
/// weighted by length. 0 where there is none.
double typical_length(std::span<const FieldArrow> arrows);

/// Name of a unit after a number: `spacing` and `spacings`.
struct UnitName {
  std::string singular;
  std::string plural;
};

/// Arrows centred in cells `cell` spacings wide; one of length `scale` spans 0.9 cells. Those that
/// are weaker are paler. The legend line is an arrow of a round length up to `scale`, labelled with
/// `unit`.
Overlay arrow_field(std::span<const FieldArrow> arrows, double cell, double scale,
                    const UnitName& unit);

}  // namespace clca::render
