#pragma once
// Requested measures and output. Lengths in lattice spacings, time in steps.

#include <cstdint>
#include <optional>
#include <string>

#include "clca/lattice/region.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::scene {

enum class Measure : std::uint8_t {
  profile,
  repose,
  runout,
  packing,
  moved,
  outflow,
  force,
  segregation,
  intruder,
  convection,
  axis_order,
  mixing,
  weight_paths
};

/// A measure that the scene derives from others.
struct DerivedMeasure {
  std::string name;
  std::string expression;            ///< an expression of measures and numbers, after `=`
  std::string unit = "1";            ///< 1: a pure number
  std::optional<std::string> about;  ///< what it is, in words
  std::string location;              ///< of the value
};

enum class ColorBy : std::uint8_t {
  species,
  /// Layers of equal thickness, by height at the start of the stage or where a source emitted it.
  stage_layer,
  displacement,
  speed,
  spin,
  coordination,
  id,
  axis,
  force,
  pressure
};
enum class DrawingMethod : std::uint8_t {
  automatic,
  polygons,
  lookup
};  ///< how: see render::DrawingMethod
/// Drawn over the grains. velocity: mean since the last picture; weight_*: see measure::WeightRule.
enum class Overlay : std::uint8_t {
  none,
  forces,
  arrows,
  velocity,
  weight_inner,
  weight_outer,
  weight_pair,
  weight_q
};
/// `print`: for papers, without title and moment.
enum class PictureStyle : std::uint8_t { screen, print };

/// Pictures that a run draws.
struct PictureOutput {
  std::uint64_t every = 10;
  std::optional<int> width = {};  ///< pixels; none: follows the aspect of the view
  std::optional<int> height = {};
  ColorBy color_by = ColorBy::species;
  std::optional<statistics::Range> color_range =
      {};                                       ///< ends of the colour bar; none: from the scene
  int layer_count = 8;                          ///< for ColorBy::stage_layer
  std::optional<lattice::Rectangle> view = {};  ///< none: the whole box
  DrawingMethod drawing = DrawingMethod::automatic;
  int supersampling = 2;
  bool has_caption = true;
  PictureStyle style = PictureStyle::screen;
  bool turns_with_vessel = false;  ///< Model::contact: shows the vessel turned, gravity down
  /// Force of the widest line, in grain weights, with Units::density in newtons; none: estimated.
  std::optional<double> widest_line_force = {};
  /// Side of a cell of Overlay::velocity; none: from grains and view.
  std::optional<double> velocity_cell_side = {};
  /// Speed of the longest arrow, in the unit of velocity of the tables; none: from the model.
  std::optional<double> longest_arrow_speed = {};
  Overlay overlay = Overlay::none;  ///< drawn over the particles
  std::string location;             ///< FILE:LINE:COLUMN, for messages

  bool operator==(const PictureOutput&) const = default;
};

/// Rows of series.csv.
struct SeriesOutput {
  std::uint64_t every = 1;
  bool has_wall_forces = false;  ///< Model::contact: columns of forces on walls and sides
};

/// Means over square cells of the plane.
struct FieldOutput {
  double cell_side = 8;  ///< side of a cell
  std::uint64_t every = 100;
};

/// Sampling of contacts for means over time.
struct ContactSampling {
  std::uint64_t every = 1;
  std::uint64_t window_steps = 100;  ///< steps of a mean of the contact model
};

/// Trajectory frames: at the start and end of each stage and at regular intervals.
struct TrajectoryOutput {
  std::uint64_t every = 10;
  bool has_contacts = false;  ///< Model::contact: saves the forces of each contact
};

/// When to save checkpoints, besides at the end or interruption of a run.
struct CheckpointIntervals {
  std::optional<std::uint64_t> every_steps;  ///< steps; not for a gas
  std::optional<double> every_seconds;       ///< wall-clock time
};

/// Default if the scene does not specify it.
inline constexpr CheckpointIntervals kDefaultCheckpoints = {.every_steps = {}, .every_seconds = 60};

struct Output {
  std::optional<PictureOutput> frames;
  std::optional<lattice::Rectangle> default_view;  ///< for pictures without a view
  std::optional<SeriesOutput> series;
  std::optional<FieldOutput> fields;
  std::optional<ContactSampling> contacts;
  std::optional<TrajectoryOutput> trajectory;
  std::optional<CheckpointIntervals> checkpoint = kDefaultCheckpoints;
};

}  // namespace clca::scene
