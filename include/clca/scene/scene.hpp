#pragma once
// A scene: everything about a run, as plain validated values. Lengths in lattice spacings from the
// lower left site, time in steps, angles in degrees. Scenes are equal when they say the same, under
// whatever file name and wherever in it.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "clca/automaton/rules.hpp"
#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::scene {

struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Color&) const = default;
};

struct Box {
  double width = 0;
  double height = 0;
  bool periodic = false;
  std::string place;  ///< FILE:LINE:COLUMN of the box, for messages; so for all of this name

  bool operator==(const Box& other) const;
};

struct HexagonSpec {
  int radius = 0;

  bool operator==(const HexagonSpec&) const = default;
};
struct SitesSpec {
  std::vector<lattice::Axial> sites;

  bool operator==(const SitesSpec&) const = default;
};
struct PolygonSpec {
  std::vector<lattice::Axial> corners;

  bool operator==(const PolygonSpec&) const = default;
};
struct RodSpec {
  int radius = 0;
  int length = 1;

  bool operator==(const RodSpec&) const = default;
};
using ShapeSpec = std::variant<HexagonSpec, SitesSpec, PolygonSpec, RodSpec>;

struct Species {
  std::string name;
  ShapeSpec shape_spec;
  lattice::Shape shape;
  std::vector<int> orientations = {0};  ///< degrees clockwise, multiples of 60
  std::optional<Color> color;           ///< none: from the default palette

  bool operator==(const Species&) const = default;
};

struct Wall {
  std::string name;
  std::variant<lattice::Rectangle, lattice::Segment> form;

  bool operator==(const Wall& other) const;
};

struct Source {
  std::string name;
  std::variant<Eigen::Vector2d, lattice::Rectangle> place;
  std::vector<std::uint32_t> weights;  ///< per species, not all zero
  double rate = 0;                     ///< particles per step
  std::optional<std::uint64_t> count;  ///< none: goes on for ever

  bool operator==(const Source&) const = default;
};

struct Outlet {
  std::string name;
  lattice::Rectangle region;

  bool operator==(const Outlet&) const = default;
};

struct Fill {
  lattice::Rectangle region;
  std::vector<std::size_t> counts;  ///< per species
  std::string place;

  bool operator==(const Fill& other) const;
};

struct UntilSettled {
  bool operator==(const UntilSettled&) const = default;
};
struct UntilSteps {
  std::uint64_t steps = 0;

  bool operator==(const UntilSteps&) const = default;
};
/// Ends when this share of the particles that were or came in during the stage has left.
struct UntilDischarged {
  double share = 0;

  bool operator==(const UntilDischarged&) const = default;
};
using Until = std::variant<UntilSettled, UntilSteps, UntilDischarged>;

struct Stage {
  std::string name;
  std::optional<Fill> fill;
  std::vector<std::size_t> remove;   ///< walls, by index
  std::vector<std::size_t> sources;  ///< open during this stage, by index
  Until until;
  std::uint64_t max_steps = 1'000'000;

  bool operator==(const Stage&) const = default;
};

enum class Measure : std::uint8_t { profile, repose, runout, packing, moved, outflow };

enum class ColorBy : std::uint8_t { species, stage_layer, displacement, speed, id };
enum class Drawing : std::uint8_t { automatic, polygons, lookup };

struct Frames {
  std::uint64_t every = 10;
  int width = 1280;
  int height = 720;
  ColorBy color_by = ColorBy::species;
  int layers = 8;                               ///< for ColorBy::stage_layer
  std::optional<lattice::Rectangle> view = {};  ///< none: the whole box
  Drawing drawing = Drawing::automatic;
  int supersampling = 2;
  bool caption = true;
  std::string place;

  bool operator==(const Frames& other) const;
};

struct Series {
  std::uint64_t every = 1;

  bool operator==(const Series&) const = default;
};

struct Output {
  std::optional<Frames> frames;
  std::optional<Series> series;

  bool operator==(const Output&) const = default;
};

struct Scene {
  std::string name;   ///< of the file, without folder and ending
  std::string title;  ///< the name where the file gives none
  std::uint64_t seed = 0;
  Box box;
  std::vector<Species> species;  ///< in the order of the file, as all lists here
  automaton::Rules rules;
  std::vector<Wall> walls;
  std::vector<Source> sources;
  std::vector<Outlet> outlets;
  std::vector<Stage> stages;
  std::vector<Measure> measures;
  Output output;

  bool operator==(const Scene& other) const;
};

}  // namespace clca::scene
