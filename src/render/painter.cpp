#include "clca/render/painter.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <utility>

#include "render/annotations.hpp"
#include "render/colors.hpp"
#include "render/graphics.hpp"
#include "render/layout.hpp"
#include "render/opengl/polygons.hpp"
#include "render/samples.hpp"
#include "render/site_lookup.hpp"

namespace clca::render {

namespace {

/// Whether the panel, turned by `turn` degrees, shows the middle of the arrow, which then is moved
/// so that it shows all of it. In pixels.
bool moved_into_view(Stroke& arrow, const PixelBox& panel, double turn) {
  const Eigen::Rotation2Dd turned(-turn * std::numbers::pi / 180);
  const Eigen::Array2d half(panel.width / 2.0, panel.height / 2.0);
  const Eigen::Vector2d along = turned * (arrow.to - arrow.from);
  const Eigen::Array2d middle =
      (turned * ((arrow.from + arrow.to) / 2 - half.matrix())).array();  // from that of the panel
  constexpr double kHead = 1.7;  // half of its width, in widths of the arrow
  const Eigen::Array2d room = half - along.array().abs() / 2 - kHead * arrow.width;
  const Eigen::Vector2d shift = turned.inverse() * (middle.max(-room).min(room) - middle).matrix();
  arrow.from += shift;
  arrow.to += shift;
  return (middle.abs() <= half).all();
}

/// Overlapping particles: the lower id last, so that it lies on top.
std::vector<Body> bodies_in_view(const Projection& projection, const grains::State& state,
                                 const Coloring& coloring) {
  const lattice::Rectangle view = projection.view();
  const double width = state.lattice.extent().x();
  std::vector<Body> bodies;
  for (std::size_t id = state.particles.size(); id-- > 0;) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const lattice::Site home = {state.lattice.wrapped(particle.column), particle.row};
    const lattice::Axial from_corner = home - lattice::Site{0, 0};
    const Eigen::Vector2d at = lattice::position(home);
    const double reach = state.shape(particle).diameter() + 1;
    // At a periodic boundary a particle appears at both sides.
    const int images = state.lattice.periodic() ? 1 : 0;
    for (int image = -images; image <= images; ++image) {
      const double x = at.x() + image * width;
      const bool in_box = images == 0 || (x + reach > -1 && x - reach < width);
      if (in_box && x + reach > view.left && x - reach < view.right &&
          at.y() + reach > view.bottom && at.y() - reach < view.top) {
        const int columns = image * state.lattice.columns();  // to there, at the same height
        const lattice::Axial place =
            from_corner + from_corner + lattice::Axial{2 * columns, -columns};
        bodies.push_back({particle.kind, place, coloring.palette[coloring.palette_indices[id]]});
      }
    }
  }
  return bodies;
}

Projection without_outlines(Projection projection) {
  projection.outline_strength = 0;
  return projection;
}

}  // namespace

struct Capture::Content {
  Image panel;  ///< unless there are polygons
  // For polygons and vector graphics: all but the particles, and these.
  Image walls;
  std::vector<Body> bodies;
};

struct Painter::Impl {
  Impl(const Style& wanted, const lattice::Lattice& where, const std::vector<grains::Kind>& kinds)
      : style(with_view_and_size(wanted, where)),
        lattice(where),
        layout(layout_of(style.width, style.height, style.view, style.annotations)),
        projection(projection_of(style.view, layout, style.supersampling, style.height)),
        lookup(lattice, projection, style.supersampling, style.threads),
        walls(lattice, without_outlines(projection), 1, style.threads) {
    for (const grains::Kind& kind : kinds) {
      outlines.push_back(outline(kind.shape));
    }
    if (style.drawing == DrawingMethod::polygons) {
      polygons = polygon_painter(projection, style.supersampling,
                                 projection.samples_in(box_with_frame(lattice)), kinds);
    }
  }

  /// Of a point of the plane, from the upper left corner of the panel.
  Eigen::Vector2d pixel(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d from_corner = layout.pixels_per_spacing * (point - projection.corner);
    return {from_corner.x(), layout.panel.height - from_corner.y()};
  }

  /// The picture around what `draw_particles` draws into the panel.
  template <class DrawParticles>
  void draw(Graphics& graphics, const Legend& captured, const Caption& caption,
            const Overlay& overlay, double turn, DrawParticles draw_particles) const {
    const PixelBox& box = layout.panel;
    graphics.draw_clipped(box.x, box.y, box.width, box.height, [&] {
      graphics.move_into(box, turn);
      draw_particles();
      graphics.fade(overlay.fade);
      for (const Stroke& stroke : overlay.strokes) {
        Stroke drawn = {pixel(stroke.from), pixel(stroke.to),
                        stroke.width * layout.pixels_per_spacing, stroke.color, stroke.is_arrow};
        if (!drawn.is_arrow || moved_into_view(drawn, box, turn)) {
          graphics.draw_stroke(drawn);
        }
      }
    });
    Legend legend = captured;
    legend.fade = overlay.fade;
    annotate(graphics, layout, caption, legend);
  }

  /// As vector graphics, but for the walls: those are a picture with a pixel for each sample.
  void draw_panel(Graphics& graphics, const Capture::Content& captured) const {
    graphics.draw_image(captured.walls, 0, 0, layout.panel.width, layout.panel.height);
    const lattice::Rectangle box = box_with_frame(lattice);
    // Cairo counts pixels to 8 million.
    const Eigen::Vector2d size(layout.panel.width, layout.panel.height);
    const auto in_panel = [&](double x, double y) -> Eigen::Vector2d {
      return pixel({x, y}).cwiseMax(-size).cwiseMin(2 * size);
    };
    const Eigen::Vector2d low = in_panel(box.left, box.top);
    const Eigen::Vector2d high = in_panel(box.right, box.bottom);
    graphics.draw_clipped(low.x(), low.y(), high.x() - low.x(), high.y() - low.y(), [&] {
      std::vector<Eigen::Vector2d> corners;
      for (const Body& body : captured.bodies) {
        corners.clear();
        for (const lattice::Axial corner : outlines[body.kind]) {
          corners.push_back(pixel(position_from_halves(body.place + corner)));
        }
        graphics.fill_polygon(corners, body.fill,
                              projection.outline_width * layout.pixels_per_spacing,
                              outline_color(body.fill, projection.outline_strength));
      }
    });
  }

  Style style;
  lattice::Lattice lattice;
  Layout layout;
  Projection projection;
  SiteLookup lookup;
  SiteLookup walls;               ///< with a pixel for each sample
  std::vector<Outline> outlines;  ///< by kind
  PolygonPainter polygons;        ///< none for the lookup
};

Painter::Painter(const Style& style, const lattice::Lattice& lattice,
                 const std::vector<grains::Kind>& kinds)
    : impl_(std::make_unique<Impl>(style, lattice, kinds)) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Capture Painter::capture(const grains::State& state, const grains::Occupancy& occupancy,
                         const Coloring& coloring) {
  if (state.lattice != impl_->lattice || state.kinds.size() != impl_->outlines.size()) {
    throw std::invalid_argument("the painter was made for another lattice or other kinds");
  }
  if (coloring.palette_indices.size() != state.particles.size()) {
    throw std::invalid_argument("the colours are those of another state");
  }
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    if (state.particles[id].present && coloring.palette_indices[id] >= coloring.palette.size()) {
      throw std::invalid_argument("a shade is not in the palette");
    }
  }
  auto content = std::make_shared<Capture::Content>();
  if (!impl_->polygons) {
    content->panel = impl_->lookup.picture(state, occupancy, coloring);
  }
  if (impl_->polygons || impl_->style.for_pdf) {
    content->walls =
        impl_->walls.picture(state, occupancy,
                             {.palette_indices = std::vector<std::uint16_t>(state.particles.size()),
                              .palette = {kPaper}});
    content->bodies = bodies_in_view(impl_->projection, state, coloring);
  }
  Capture capture = {.content = std::move(content), .legend = coloring.legend};
  add_wall_entries(capture.legend, std::ranges::any_of(state.walls, is_moving_wall));
  return capture;
}

Image Painter::rasterize(const Capture& captured, const Caption& caption, const Overlay& overlay,
                         double turn) {
  const Style& style = impl_->style;
  const PixelBox& box = impl_->layout.panel;
  Graphics graphics(style.width, style.height);
  const Image polygons =
      impl_->polygons
          ? averaged_over_background(captured.content->walls,
                                     impl_->polygons(captured.content->bodies), style.supersampling)
          : Image();
  const Image& panel = impl_->polygons ? polygons : captured.content->panel;
  const bool bare = overlay.strokes.empty() && overlay.fade == 0 && turn == 0;
  impl_->draw(graphics, captured.legend, caption, overlay, turn, [&] {
    if (!bare) {
      graphics.draw_image(panel, 0, 0, box.width, box.height);
    }
  });
  Image image = graphics.image(bare ? box : PixelBox{});
  if (bare) {
    paste(panel, image, box.x, box.y);
  }
  return image;
}

std::vector<std::uint8_t> Painter::pdf(const Capture& captured, const Caption& caption,
                                       const Overlay& overlay, double turn) {
  Graphics graphics(width(), height(), Graphics::Medium::page);
  impl_->draw(graphics, captured.legend, caption, overlay, turn,
              [&] { impl_->draw_panel(graphics, *captured.content); });
  return graphics.pdf(fmt::format("{}: {}", caption.title, caption.detail));
}

double Painter::bytes_for(const Style& style, double particles, int captures) {
  const PixelBox size = picture_size(style.width, style.height, style.view, style.annotations);
  const double pixels = static_cast<double>(size.width) * size.height;
  // In Cairo, of the view in captures and lookup, of the picture; what the lookup remembers.
  double bytes = pixels * (4 + (captures + 2.0) * sizeof(Rgb) + sizeof(grains::Owner)) +
                 particles * 4 * sizeof(Sample);
  bytes += particles * (sizeof(double) + 2 * sizeof(std::uint16_t));  // values and their shades
  if (style.for_pdf || style.drawing == DrawingMethod::polygons) {
    // Of the walls in captures and lookup, on the canvas and as it is read.
    const double samples = pixels * style.supersampling * style.supersampling;
    bytes += samples * ((captures + 1.0) * sizeof(Rgb) + 2 * sizeof(Sample)) +
             particles * captures * static_cast<double>(sizeof(Body));
  }
  return bytes;
}

int Painter::width() const {
  return impl_->style.width;
}

int Painter::height() const {
  return impl_->style.height;
}

PictureView Painter::view() const {
  return {impl_->layout.panel, impl_->layout.pixels_per_spacing};
}

Image Painter::draw(const grains::State& state, const grains::Occupancy& occupancy,
                    const Coloring& coloring, const Caption& caption, const Overlay& overlay) {
  return rasterize(capture(state, occupancy, coloring), caption, overlay);
}

}  // namespace clca::render
