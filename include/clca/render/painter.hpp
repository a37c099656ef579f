#pragma once
// Draws the state of an automaton off screen.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/automaton/occupancy.hpp"
#include "clca/automaton/state.hpp"
#include "clca/render/image.hpp"
#include "clca/render/overlay.hpp"

namespace clca::render {

/// The driver cannot do what was asked: a picture too large, an unknown GALLIUM_DRIVER.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How particles are drawn: outlines of polygons, one instance a particle; or the lookup shader
/// that finds the owner of each pixel's site. Both give the same picture but for rounding at edges
/// and for overlaps: polygons lie over walls, the lookup shows the first owner of each site.
enum class Drawing : std::uint8_t { automatic, polygons, lookup };

struct Style {
  int width = 1280;  ///< pixels of the finished picture
  int height = 720;
  int supersampling = 2;  ///< samples a pixel along each axis, 1 to 4
  Drawing drawing = Drawing::automatic;
  /// Part of the plane to show, lattice spacings. Left empty: all of the box (whole_box).
  lattice::Rectangle view;
  bool annotations = true;  ///< captions, scale bar, legend; needs a font
};

/// Explains the colours of a picture: named patches, a bar of a colour map from low to high, and
/// lines or arrows as the overlay has them.
struct Legend {
  struct Patch {
    std::string label;
    Rgb color;
  };
  struct Bar {
    std::string label;  ///< with the unit
    double low = 0;
    double high = 1;
  };
  struct Line {
    std::string label;
    double width = 0.5;  ///< lattice spacings; drawn no thicker than a line of text
    double length = 0;   ///< lattice spacings; 0 where it tells nothing
    Rgb color = {};
    bool arrow = false;
  };
  std::vector<Patch> patches;
  std::vector<Bar> bars;  ///< none or one
  std::vector<Line> lines;
};

/// One colour per particle id, and what the colours mean.
struct Coloring {
  std::vector<Rgb> colors;
  Legend legend;
};

struct Caption {
  std::string title;
  std::string detail;  ///< such as "flow, step 120"
};

class Painter {
 public:
  /// For states on `lattice` with `kinds`. Throws RenderError.
  Painter(const Style& style, const lattice::Lattice& lattice,
          const std::vector<automaton::Kind>& kinds);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;

  Image draw(const automaton::State& state, const automaton::Occupancy& occupancy,
             const Coloring& coloring, const Caption& caption, const Overlay& overlay = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The box and its frame, floor and side walls drawn a few spacings thick.
lattice::Rectangle whole_box(const lattice::Lattice& lattice);

/// Checks the driver's settings in the environment of the process and asks for rasterisation in
/// the calling thread, unless the user has chosen a number of threads (LP_NUM_THREADS). Each
/// Painter does so; who draws from several threads does it before they start, as the environment
/// must not change under them. Throws RenderError.
void prepare_environment();

/// Warning that annotations cannot be drawn, empty when they can: no font was found.
std::string font_problem();

}  // namespace clca::render
