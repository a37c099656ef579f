#pragma once
// A scene: all parameters of a run as validated values. Lengths in lattice spacings from the lower
// left site, time in steps, angles in degrees.
// `location`: FILE:LINE:COLUMN, for messages.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clca/automaton/automaton.hpp"
#include "clca/baxter/baxter_model.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/grains/model.hpp"
#include "clca/grains/motion.hpp"
#include "clca/grains/state.hpp"
#include "clca/image/image.hpp"
#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"
#include "clca/scene/output.hpp"
#include "clca/voids/void_model.hpp"

namespace clca::scene {

/// Degrees between neighbouring orientations of a particle.
inline constexpr int kOrientationStep = 360 / lattice::kDirectionCount;

struct Box {
  double width = 0;
  double height = 0;
  bool periodic = false;
  std::string location;
};

struct HexagonSpec {
  int radius = 0;
};
struct DiscSpec {
  double radius = 0;
};
struct SitesSpec {  // a shape by its sites
  std::vector<lattice::Axial> sites;
};
struct PolygonSpec {
  std::vector<lattice::Axial> corners;
};
struct RectangleSpec {
  double width = 0;  ///< lattice spacings
  double height = 0;
};
struct OutlineSpec {
  std::vector<Eigen::Vector2d> corners;  ///< lattice spacings
};
struct RodSpec {
  int radius = 0;
  int length = 1;
};
using ShapeSpec = std::variant<HexagonSpec, DiscSpec, RectangleSpec, OutlineSpec, SitesSpec,
                               PolygonSpec, RodSpec>;

struct Species {
  std::string name;
  ShapeSpec shape_spec;
  lattice::Shape shape = lattice::Shape::hexagon(0);
  std::vector<int> orientations = {0};  ///< degrees clockwise, multiples of 60
  std::optional<image::Rgb> color;      ///< none: from the default palette
  double sieve = 1;                     ///< for Model::voids, see voids::Rules
};

/// The model that moves the grains.
enum class Model : std::uint8_t { automaton, contact, voids, baxter };

/// Real units of the contact model.
struct Units {
  double spacing = 0;     ///< of the lattice, metres
  double gravity = 9.81;  ///< metres per second squared
  /// Kilograms per square metre of grains; none: masses have no unit.
  std::optional<double> density = {};
};

/// All lengths in lattice spacings.
struct Disc {
  Eigen::Vector2d centre;
  double radius = 0;
};

/// From `radius` to `radius + thickness` from the centre.
struct Ring {
  Eigen::Vector2d centre;
  double radius = 0;
  double thickness = 1;
};

/// The part of a ring from one angle anticlockwise to another, in degrees from the x axis.
struct Arc {
  Ring ring;
  double from_degrees = 0;
  double to_degrees = 0;  ///< above `from`, by less than 360
};

using CircularPart = std::variant<Disc, Ring, Arc>;

using WallPart =
    std::variant<lattice::Rectangle, lattice::Segment, Disc, Ring, Arc, lattice::Picture>;

/// One body. Without motion each part has a site in the box; see check_walls for moving walls.
struct Wall {
  std::string name;
  std::vector<WallPart> parts;
  std::optional<grains::WallMotion> motion = {};
  grains::PassiveRule passive_rule = grains::PassiveRule::rigid;  ///< of one that moves
  std::optional<double> friction = {};  ///< of Model::contact; none: Parameters::wall_friction
  std::string location = {};
};

struct Source {
  std::string name;
  std::variant<Eigen::Vector2d, lattice::Rectangle> position;
  std::vector<std::uint32_t> species_weights;  ///< per species, not all zero
  double particles_per_step = 0;               ///< particles per step
  std::optional<std::uint64_t> max_particles;  ///< none: goes on for ever
  std::string location = {};
};

struct Outlet {
  std::string name;
  lattice::Rectangle region;
  std::string location = {};
};

/// A region of the box that is observed; see clca/measure/field_grid.hpp.
struct Probe {
  std::string name;
  lattice::Rectangle region;
};

/// A straight line on which flow is measured, in parts of equal length; see clca/measure/line.hpp.
struct Line {
  std::string name;
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  int part_count = 20;
};

/// Random sequential addition (grains then fall) or deposition (at rest), see grains::Model::fill.
enum class FillMethod : std::uint8_t { random, deposition };

/// Divides the region of a fill into parts, one for each letter of the picture.
struct FillPicture {
  std::vector<std::string> rows;  ///< of letters, see grains::Mixture
  std::map<char, std::vector<std::uint32_t>> weights_by_letter;  ///< by species
};

/// Has counts, weights or a picture; without counts the region is filled until it is full.
struct Fill {
  FillMethod method = FillMethod::random;
  lattice::Rectangle region;
  std::vector<std::size_t> species_counts;     ///< per species, or empty
  std::vector<std::uint32_t> species_weights;  ///< weights per species, or empty
  std::optional<FillPicture> picture;
  std::optional<double> level;  ///< mean height of the surface where a deposited mix ends
  std::string location;
};

struct UntilSettled {};
struct UntilSteps {
  std::uint64_t steps = 0;
};
/// Ends when this share of all particles present or emitted during the stage has left.
struct UntilDischarged {
  double discharged_share = 0;
};
/// Ends when all periodic walls and the vessel have completed this many cycles.
struct UntilCycles {
  std::uint64_t cycles = 0;
};
/// Contact model only.
struct UntilTime {
  double time = 0;          ///< in the unit of time of UnitConversion
  std::uint64_t steps = 0;  ///< the same time in steps
};
using EndCondition =
    std::variant<UntilSettled, UntilSteps, UntilDischarged, UntilCycles, UntilTime>;

/// The mixture of a fill; none if it has counts.
std::optional<grains::Mixture> mixture_of(const Fill& fill);
/// Whether the fill places particles of the species.
bool places_species(const Fill& fill, std::size_t species);

/// Number of steps, for ends given by steps or time.
std::optional<std::uint64_t> fixed_steps(const EndCondition& until);

/// Tilts the vessel to an angle from upright, degrees anticlockwise: at once, or with `rate`
/// degrees per unit of time (of UnitConversion).
struct Tilt {
  double to_degrees = 0;
  std::optional<double> degrees_per_time;
};
/// Turns continuously with `rate` turns per unit of time; positive is anticlockwise.
struct Rotate {
  double turns_per_time = 0;
  std::optional<Eigen::Vector2d> centre;  ///< none: of the box
};
/// Sinusoidal shaking.
struct VesselShake {
  double gamma = 0;      ///< greatest acceleration over that of gravity
  double amplitude = 0;  ///< in lattice spacings
  bool sideways = false;
};
/// Motion of the vessel of Model::contact.
using VesselMotion = std::variant<Tilt, Rotate, VesselShake>;

inline constexpr std::uint64_t kMaxSteps = 1'000'000'000'000;

struct Stage {
  std::string name;
  std::optional<Fill> fill;
  std::vector<std::size_t> removed_walls;          ///< walls, by index
  std::vector<std::size_t> inserted_walls;         ///< likewise; see walls_present_at_start
  std::vector<std::size_t> moving_walls;           ///< walls in motion during this stage, by index
  std::vector<std::size_t> open_sources;           ///< open during this stage, by index
  std::optional<VesselMotion> vessel_motion = {};  ///< none: it rests as it stands
  // Replace those of the scene during this stage.
  std::optional<automaton::Rules> automaton_rules = {};
  std::optional<contact::Parameters> contact_parameters =
      {};  ///< differ in friction and restitution only
  EndCondition until;
  std::uint64_t max_steps = 1'000'000;  ///< at most kMaxSteps
  std::string insert_location;          ///< of the list `insert`
};

/// Whether the vessel rotates or is shaken in the stage, and so has cycles.
bool vessel_has_cycles(const Stage& stage);

/// The state of another run that a run begins with.
struct InitialState {
  std::string run_folder;                   ///< its folder, as an absolute path
  std::optional<std::uint64_t> step;        ///< of its trajectory; none: its end
  std::optional<std::uint64_t> state_hash;  ///< hash; another state is refused
  std::uint64_t particles = 0;              ///< in that state; 0 until run::resolve_begin()
  std::string location;
};

struct Scene {
  std::string name;    ///< of the file, without folder and ending
  std::string folder;  ///< of the file; relative paths in the scene begin there
  std::string title;   ///< the name where the file gives none
  std::uint64_t seed = 1;
  Model model = Model::automaton;
  std::optional<InitialState> initial_state;  ///< none: an empty box
  Box box;
  std::vector<Species> species;            ///< in the order of the file, as all lists here
  automaton::Rules automaton_rules;        ///< of Model::automaton
  contact::Parameters contact_parameters;  ///< of Model::contact
  voids::Rules voids_rules;                ///< of Model::voids; the species have the sieve
  baxter::Rules baxter_rules;              ///< of Model::baxter
  std::optional<Units> units;              ///< of Model::contact
  std::vector<Wall> walls;
  std::vector<Source> sources;
  std::vector<Outlet> outlets;
  std::vector<Probe> probes;  ///< observed at the steps of Output::series
  std::vector<Line> lines;    ///< likewise
  std::vector<Stage> stages;
  std::vector<Measure> measures;
  std::vector<DerivedMeasure> derived_measures;  ///< each from those before it, too
  Output output;
};

/// Number of digits of the steps in file names, at least six, so that the names are in the order of
/// the steps. A stage without a number of steps counts where its `max_steps` is above the default.
int step_digits(const Scene& scene);

/// Smallest number of steps in which the stage can end; 0 if unknown. At most kMaxSteps + 1.
std::uint64_t least_steps(const Stage& stage, const Scene& scene);

bool shows_weight_paths(Overlay overlay);
/// Whether its pictures show forces of the contact model.
bool pictures_show_forces(const Scene& scene);
/// Whether its pictures show velocities computed from the positions at the previous picture.
bool pictures_compare_positions(const Scene& scene);

/// Degrees clockwise for each kind: the first orientation of its species that looks like it.
std::vector<int> orientation_degrees(const Scene& scene, const std::vector<grains::Kind>& kinds);

}  // namespace clca::scene
