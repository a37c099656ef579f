#pragma once
// Draws states off screen.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/image.hpp"
#include "clca/render/overlays.hpp"

namespace clca::render {

/// This cannot be drawn: the picture is too large, or nothing here draws polygons.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How particles are drawn: by lookup of the site owners around each sample, which is cheaper and
/// gives the same bytes everywhere, or as polygons by OpenGL.
/// Both give the same picture except for rounding at edges and for overlaps: polygons lie over
/// walls, the lookup shows the first owner of a site.
enum class DrawingMethod : std::uint8_t { lookup, polygons };

/// What stands around the view: nothing, a legend with a scale bar, or these and captions.
enum class Annotations : std::uint8_t { none, legend, all };

struct Style {
  int width = 1280;  ///< pixels of the finished picture; 0: follows the aspect of the view
  int height = 720;
  int supersampling = 2;  ///< samples a pixel along each axis, 1 to 4
  DrawingMethod drawing = DrawingMethod::lookup;
  lattice::Rectangle view;  ///< part of the plane to show, lattice spacings; empty: the whole box
  Annotations annotations = Annotations::all;  ///< none without a font
  int threads = 1;       ///< of Painter::capture(); pictures do not depend on it
  bool for_pdf = false;  ///< captures serve Painter::pdf()
};

struct Caption {
  std::string title;
  std::string detail;             ///< such as "flow, step 120"
  double metres_per_spacing = 0;  ///< for the scale bar; 0: it counts spacings
};

/// What a picture needs of a state. Copies share it.
struct Capture {
  struct Content;
  std::shared_ptr<const Content> content;
  Legend legend = {};  ///< with the walls of the state
};

/// Draws in two steps: capture() reads the state, rasterize() makes the picture. One thread may
/// capture the next picture while another rasterizes.
class Painter {
 public:
  /// For states on `lattice` with `kinds`. Throws RenderError.
  Painter(const Style& style, const lattice::Lattice& lattice,
          const std::vector<grains::Kind>& kinds);
  /// Bytes that a painter takes at most for so many particles, with so many captures at a time.
  /// The style has a view.
  static double bytes_for(const Style& style, double particles, int captures);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;

  /// Reads what the picture needs; the state may change afterwards. `occupancy` belongs to `state`.
  /// The cost depends on the number of samples, and on what has changed since the last capture.
  Capture capture(const grains::State& state, const grains::Occupancy& occupancy,
                  const Coloring& coloring);
  /// Makes the picture from a capture of this painter. The content is turned anticlockwise by
  /// `turn` degrees about the middle of the view.
  Image rasterize(const Capture& captured, const Caption& caption, const Overlay& overlay = {},
                  double turn = 0);

  /// The same as vector graphics, which stay sharp in any size; of captures with Style::for_pdf.
  std::vector<std::uint8_t> pdf(const Capture& captured, const Caption& caption,
                                const Overlay& overlay = {}, double turn = 0);

  int width() const;  ///< pixels of a picture
  int height() const;
  PictureView view() const;

  /// capture() and rasterize().
  Image draw(const grains::State& state, const grains::Occupancy& occupancy,
             const Coloring& coloring, const Caption& caption, const Overlay& overlay = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The rectangle of the box and its frame: floor and side walls a few spacings thick.
lattice::Rectangle box_with_frame(const lattice::Lattice& lattice);

/// Checks the settings of OpenGL in the environment, selects single-threaded rasterisation, unless
/// LP_NUM_THREADS is set, and loads the driver. Throws RenderError.
/// Each Painter of polygons calls this. Programs that draw from several threads call it before they
/// start them.
void prepare_opengl();

/// A warning if annotations cannot be drawn because no font was found; else empty.
std::string font_warning();

}  // namespace clca::render
