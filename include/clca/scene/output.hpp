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
  std::string value;                 ///< an expression of measures and numbers, after `=`
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
enum class Drawing : std::uint8_t { automatic, polygons, lookup };  ///< how: see render::Drawing
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
struct Frames {
  std::uint64_t every = 10;
  std::optional<int> width = {};  ///< pixels; none: follows the aspect of the view
  std::optional<int> height = {};
  ColorBy color_by = ColorBy::species;
  std::optional<statistics::Range> range = {};  ///< ends of the colour bar; none: from the scene
  int layers = 8;                               ///< for ColorBy::stage_layer
  std::optional<lattice::Rectangle> view = {};  ///< none: the whole box
  Drawing drawing = Drawing::automatic;
  int supersampling = 2;
  bool caption = true;
  PictureStyle style = PictureStyle::screen;
  bool upright = false;  ///< Model::contact: shows the vessel turned, gravity down
  /// Force of the widest line, in grain weights, with Units::density in newtons; none: estimated.
  std::optional<double> force_scale = {};
  /// Side of a cell of Overlay::velocity; none: from grains and view.
  std::optional<double> velocity_cell = {};
  /// Speed of the longest arrow, in the unit of velocity of the tables; none: from the model.
  std::optional<double> velocity_scale = {};
  Overlay overlay = Overlay::none;  ///< drawn over the particles
  std::string location;             ///< FILE:LINE:COLUMN, for messages

  bool operator==(const Frames&) const = default;
};

/// Rows of series.csv.
struct Series {
  std::uint64_t every = 1;
  bool forces = false;  ///< Model::contact: columns of forces on walls and sides
};

/// Means over square cells of the plane.
struct Fields {
  double cell = 8;  ///< side of a cell
  std::uint64_t every = 100;
};

/// Sampling of contacts for means over time.
struct Contacts {
  std::uint64_t every = 1;
  std::uint64_t window = 100;  ///< steps of a mean of the contact model
};

/// Trajectory frames: at the start and end of each stage and at regular intervals.
struct TrajectoryOutput {
  std::uint64_t every = 10;
  bool contacts = false;  ///< Model::contact: saves the forces of each contact
};

/// When to save checkpoints, besides at the end or interruption of a run.
struct Checkpoints {
  std::optional<std::uint64_t> every;  ///< steps; not for a gas
  std::optional<double> seconds;       ///< wall-clock time
};

/// Default if the scene does not specify it.
inline constexpr Checkpoints kDefaultCheckpoints = {.every = {}, .seconds = 60};

struct Output {
  std::optional<Frames> frames;
  std::optional<lattice::Rectangle> view;  ///< for pictures without a view
  std::optional<Series> series;
  std::optional<Fields> fields;
  std::optional<Contacts> contacts;
  std::optional<TrajectoryOutput> trajectory;
  std::optional<Checkpoints> checkpoint = kDefaultCheckpoints;
};

}  // namespace clca::scene
