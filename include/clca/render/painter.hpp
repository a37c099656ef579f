#pragma once
// Draws the state of an automaton off screen.

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/image.hpp"
#include "clca/render/overlay.hpp"

namespace clca::render {

/// The driver cannot do what was asked: a picture too large, an unknown GALLIUM_DRIVER.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How particles are drawn: outlines of polygons, one instance a particle; or by lookup, which
/// finds for each sample who owns the sites around it. Both give the same picture but for rounding
/// at edges and for overlaps: polygons lie over walls, the lookup shows the first owner of each
/// site.
enum class Drawing : std::uint8_t { automatic, polygons, lookup };

struct Style {
  int width = 1280;  ///< pixels of the finished picture
  int height = 720;
  int supersampling = 2;  ///< samples a pixel along each axis, 1 to 4
  Drawing drawing = Drawing::automatic;
  /// Part of the plane to show, lattice spacings. Left empty: all of the box (whole_box).
  lattice::Rectangle view;
  bool annotations = true;  ///< captions, scale bar, legend; needs a font
  int threads = 1;          ///< that share the work of Painter::expose(); pictures are the same
};

struct Caption {
  std::string title;
  std::string detail;  ///< such as "flow, step 120"
  double spacing = 0;  ///< of the lattice in metres, for the scale bar; 0: it counts spacings
};

/// What a picture shows of a state. Holds as much memory as the picture has samples, whatever the
/// size of the state. A cheap handle: copies share it.
class Exposure {
 public:
  struct Content;
  explicit Exposure(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
  const Content& content() const { return *content_; }

 private:
  std::shared_ptr<const Content> content_;
};

/// Draws in two steps, as a camera does: one thread may expose the next picture while another one
/// develops.
class Painter {
 public:
  /// For states on `lattice` with `kinds`. Throws RenderError.
  Painter(const Style& style, const lattice::Lattice& lattice,
          const std::vector<grains::Kind>& kinds);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  Painter(Painter&&) noexcept;
  Painter& operator=(Painter&&) noexcept;

  /// Takes what the picture needs of a state, which may go on then. `occupancy`: that of `state`.
  /// What it takes time for is the samples of the picture, not particles or sites.
  Exposure expose(const grains::State& state, const grains::Occupancy& occupancy,
                  const Coloring& coloring);
  /// Makes the picture. `exposure`: of this painter. What the box shows is turned anticlockwise by
  /// `turn` degrees about the middle of the view.
  Image develop(const Exposure& exposure, const Caption& caption, const Overlay& overlay = {},
                double turn = 0);

  /// Both.
  Image draw(const grains::State& state, const grains::Occupancy& occupancy,
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
