#pragma once
// What is commonly drawn over particles: force networks and fields of arrows.

#include <Eigen/Core>
#include <span>
#include <string>

#include "clca/render/overlay.hpp"
#include "clca/render/painter.hpp"

namespace clca::render {

/// A contact that carries force, between two places in lattice spacings.
struct ForceLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double strength = 0;
};

/// Lines as wide as their strength, up to `strongest`, the strong ones on top. Those without
/// strength are left out.
Overlay force_network(std::span<const ForceLine> lines, double strongest);

/// Legend of a force network: the line of a contact of the strength `strongest`.
Legend::Line force_key(double strongest, std::string label);

/// A vector at the centre of a cell (lattice spacings), in any unit.
struct FieldArrow {
  Eigen::Vector2d at;
  Eigen::Vector2d vector;
};

/// Arrows with their middle at the centres of cells `cell` spacings wide; one as long as `longest`
/// takes up 0.9 cells. Weak ones are paler.
Overlay arrow_field(std::span<const FieldArrow> arrows, double cell, double longest);

/// Legend of a field of arrows: a round length up to `longest`, labelled as so many of `unit`.
Legend::Line arrow_key(double cell, double longest, const std::string& unit);

}  // namespace clca::render
