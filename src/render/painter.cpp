#include "clca/render/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/annotations.hpp"
#include "render/canvas.hpp"
#include "render/colors.hpp"
#include "render/layout.hpp"
#include "render/lookup_painter.hpp"
#include "render/polygon_painter.hpp"

namespace clca::render {

namespace {

constexpr int kLargestSupersampling = 4;

double frame_thickness(const lattice::Lattice& lattice) {
  const double width = lattice.columns() * lattice::kColumnPitch;
  return std::max(1.0, 0.005 * std::max(width, static_cast<double>(lattice.rows())));
}

lattice::Rectangle checked_view(const Style& style, const lattice::Lattice& lattice) {
  if (style.width < 1 || style.height < 1) {
    throw RenderError(
        fmt::format("a picture of {} x {} pixels: at least 1 x 1", style.width, style.height));
  }
  if (style.supersampling < 1 || style.supersampling > kLargestSupersampling) {
    throw RenderError(fmt::format("supersampling is {}: 1 to {} are allowed", style.supersampling,
                                  kLargestSupersampling));
  }
  const lattice::Rectangle view =
      style.view == lattice::Rectangle{} ? whole_box(lattice) : style.view;
  const double width = view.right - view.left;
  const double height = view.top - view.bottom;
  if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height))) {
    throw RenderError("the view to draw is empty or without bounds");
  }
  return view;
}

/// Outlines are thin, but not thinner than pixels can show, and fade out where sites become too
/// small for them.
void set_outline(Projection& projection, double pixels_per_spacing, int picture_height) {
  constexpr double kThin = 0.1;   // lattice spacings
  constexpr double kThick = 0.2;  // must stay below 0.4, where the lookup loses sight of the edge
  constexpr double kNone = 1.5;   // pixels a spacing
  constexpr double kFull = 4.0;
  const double visible = std::max(0.8, picture_height / 1440.0) / pixels_per_spacing;
  projection.outline_width = std::clamp(visible, kThin, kThick);
  projection.outline_strength =
      std::clamp((pixels_per_spacing - kNone) / (kFull - kNone), 0.0, 1.0);
}

Projection projection_of(const lattice::Rectangle& view, const Layout& layout, int samples,
                         const lattice::Lattice& lattice, int picture_height) {
  Projection projection;
  projection.width = layout.panel.width * samples;
  projection.height = layout.panel.height * samples;
  projection.scale = layout.scale * samples;
  projection.corner = {view.left, view.bottom};
  const lattice::Rectangle box = whole_box(lattice);
  const Eigen::Vector2d middle(std::clamp((view.left + view.right) / 2, box.left, box.right),
                               std::clamp((view.bottom + view.top) / 2, box.bottom, box.top));
  projection.anchor = lattice::nearest_site(middle);
  projection.anchor.column -= lattice::is_odd(projection.anchor.column) ? 1 : 0;
  set_outline(projection, layout.scale, picture_height);
  return projection;
}

void paste(const Image& panel, const PixelBox& place, Image& picture) {
  for (int y = 0; y < panel.height; ++y) {
    const auto from = panel.pixels.begin() + static_cast<std::ptrdiff_t>(y) * panel.width;
    const auto to =
        picture.pixels.begin() + static_cast<std::ptrdiff_t>(place.y + y) * picture.width + place.x;
    std::copy(from, from + panel.width, to);
  }
}

}  // namespace

class Painter::Impl {
 public:
  Impl(const Style& style, const lattice::Lattice& lattice,
       const std::vector<automaton::Kind>& kinds)
      : style_(style),
        lattice_(lattice),
        view_(checked_view(style, lattice)),
        layout_(
            arrange(style.width, style.height, view_, style.annotations && font_problem().empty())),
        projection_(projection_of(view_, layout_, style.supersampling, lattice, style.height)),
        canvas_(layout_.panel.width, layout_.panel.height, style.supersampling) {
    Canvas::Session session(canvas_);
    canvas_.require_size(style.width, style.height, style.supersampling);
    lookup_.emplace(canvas_.gl(), lattice);
    polygons_.emplace(canvas_.gl(), lattice, kinds);
    if (layout_.text_size > 0) {
      annotator_.emplace();
    }
    kind_count_ = kinds.size();
  }

  Image draw(const automaton::State& state, const automaton::Occupancy& occupancy,
             const Coloring& coloring, const Caption& caption) {
    require_match(state, occupancy, coloring);
    Image picture(style_.width, style_.height, kPaper);
    paste(draw_panel(state, occupancy, coloring.colors), layout_.panel, picture);
    if (annotator_) {
      annotator_->draw(picture, layout_, caption, coloring.legend);
    }
    return picture;
  }

 private:
  void require_match(const automaton::State& state, const automaton::Occupancy& occupancy,
                     const Coloring& coloring) const {
    if (state.lattice != lattice_ || state.kinds.size() != kind_count_ ||
        occupancy.owners().size() != lattice_.memory_size()) {
      throw std::invalid_argument("the painter was made for another lattice or other kinds");
    }
    if (coloring.colors.size() < state.particles.size()) {
      throw std::invalid_argument("a coloring needs one colour for each particle");
    }
  }

  bool by_polygons(const automaton::State& state) const {
    if (style_.drawing != Drawing::automatic) {
      return style_.drawing == Drawing::polygons;
    }
    // Both ways give the same picture, so the faster one is taken. Measured with llvmpipe on one
    // thread: a triangle of an instance costs as much as some six samples of the lookup.
    constexpr std::size_t kSamplesPerTriangle = 6;
    const std::size_t samples =
        static_cast<std::size_t>(projection_.width) * static_cast<std::size_t>(projection_.height);
    return kSamplesPerTriangle * polygons_->triangles(projection_, state) < samples;
  }

  Image draw_panel(const automaton::State& state, const automaton::Occupancy& occupancy,
                   std::span<const Rgb> colors) {
    Canvas::Session session(canvas_);
    if (by_polygons(state)) {
      draw_backdrop(state, occupancy);
      clip_to_box();
      polygons_->draw(projection_, state, colors);
    } else {
      clear();
      lookup_->draw(projection_, whole_box(lattice_), occupancy,
                    colors.first(state.particles.size()));
    }
    return canvas_.read();
  }

  /// Walls rarely change, and drawing them costs as much as drawing everything by lookup.
  void draw_backdrop(const automaton::State& state, const automaton::Occupancy& occupancy) {
    if (backdrop_walls_ == state.walls) {
      canvas_.restore_backdrop();
      return;
    }
    clear();
    lookup_->draw(projection_, whole_box(lattice_), occupancy, {});
    canvas_.keep_backdrop();
    backdrop_walls_ = state.walls;
  }

  void clear() {
    const Gl& gl = canvas_.gl();
    gl.Disable(GL_SCISSOR_TEST);
    gl.ClearColor(1, 1, 1, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
  }

  void clip_to_box() {
    const SampleBox box = projection_.samples_in(whole_box(lattice_));
    canvas_.gl().Scissor(box.x, box.y, box.width, box.height);
    canvas_.gl().Enable(GL_SCISSOR_TEST);
  }

  Style style_;
  lattice::Lattice lattice_;
  lattice::Rectangle view_;
  Layout layout_;
  Projection projection_;
  Canvas canvas_;
  std::optional<LookupPainter> lookup_;
  std::optional<PolygonPainter> polygons_;
  std::optional<Annotator> annotator_;
  std::optional<std::vector<automaton::Wall>> backdrop_walls_;  // those of the kept backdrop
  std::size_t kind_count_ = 0;
};

Painter::Painter(const Style& style, const lattice::Lattice& lattice,
                 const std::vector<automaton::Kind>& kinds)
    : impl_(std::make_unique<Impl>(style, lattice, kinds)) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Image Painter::draw(const automaton::State& state, const automaton::Occupancy& occupancy,
                    const Coloring& coloring, const Caption& caption) {
  return impl_->draw(state, occupancy, coloring, caption);
}

lattice::Rectangle whole_box(const lattice::Lattice& lattice) {
  const double frame = frame_thickness(lattice);
  const double side = lattice.periodic() ? 0 : frame;
  const double half = lattice::kColumnPitch / 2;
  return {.left = -half - side,
          .bottom = -0.5 - frame,
          .right = lattice.columns() * lattice::kColumnPitch - half + side,
          .top = static_cast<double>(lattice.rows())};
}

}  // namespace clca::render
