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
#include "render/projection.hpp"
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

void draw_overlay(Graphics& graphics, const Overlay& overlay, const PanelScale& panel,
                  const PixelBox& box, double turn) {
  graphics.fade(overlay.fade);
  for (const Stroke& stroke : overlay.strokes) {
    Stroke drawn = {panel.pixel(stroke.from), panel.pixel(stroke.to), stroke.width * panel.scale,
                    stroke.color, stroke.arrow};
    if (!drawn.arrow || moved_into_view(drawn, box, turn)) {
      graphics.draw_stroke(drawn);
    }
  }
}

/// Overlapping particles: the lower id last, so that it lies on top.
std::vector<Body> bodies_in_view(const Projection& projection, const grains::State& state,
                                 const grains::Occupancy& occupancy, const Coloring& coloring) {
  const lattice::Rectangle view = projection.view();
  const double width = state.lattice.size().x();
  std::vector<Body> bodies;
  for (std::size_t id = state.particles.size(); id-- > 0;) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const lattice::Site home = {state.lattice.wrapped(particle.column), particle.row};
    const Eigen::Vector2d at = lattice::position(home);
    const double reach = state.shape(particle).diameter() + 1;
    // At a periodic boundary a particle appears at both sides.
    const int images = state.lattice.periodic() ? 1 : 0;
    for (int image = -images; image <= images; ++image) {
      const double x = at.x() + image * width;
      const bool in_box = images == 0 || (x + reach > -1 && x - reach < width);
      if (in_box && x + reach > view.left && x - reach < view.right &&
          at.y() + reach > view.bottom && at.y() - reach < view.top) {
        GridPoint place = grid_point(home);
        place.u += 2 * state.lattice.columns() * image;
        bodies.push_back({particle.kind, place, color(coloring, state, occupancy, id)});
      }
    }
  }
  return bodies;
}

void draw_bodies(Graphics& graphics, std::span<const Body> bodies,
                 std::span<const Outline> outlines, const Projection& projection,
                 const PanelScale& panel) {
  std::vector<Eigen::Vector2d> corners;
  for (const Body& body : bodies) {
    corners.clear();
    for (const GridPoint corner : outlines[body.kind]) {
      corners.push_back(
          panel.pixel(position(GridPoint{body.place.u + corner.u, body.place.v + corner.v})));
    }
    graphics.fill_polygon(corners, body.fill, projection.outline_width * panel.scale,
                          outline_color(body.fill, projection.outline_strength));
  }
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
  Legend legend;
};

const Legend& Capture::legend() const {
  return content_->legend;
}

class Painter::Impl {
 public:
  Impl(const Style& style, const lattice::Lattice& lattice, const std::vector<grains::Kind>& kinds)
      : style_(completed(style, lattice)),
        lattice_(lattice),
        layout_(arrange(style_.width, style_.height, style_.view, style_.annotations)),
        projection_(projection_of(style_.view, layout_, style.supersampling, style_.height)),
        kind_count_(kinds.size()),
        lookup_(lattice, projection_, style.supersampling, style.threads),
        walls_(lattice, without_outlines(projection_), 1, style.threads) {
    for (const grains::Kind& kind : kinds) {
      outlines_.push_back(outlines(kind.shape).front());
    }
    if (style.drawing == Drawing::polygons) {
      polygons_ = polygon_painter(projection_, style.supersampling,
                                  projection_.samples_in(whole_box(lattice)), kinds);
    }
  }

  Capture capture(const grains::State& state, const grains::Occupancy& occupancy,
                  const Coloring& coloring) {
    require_match(state, coloring);
    auto content = std::make_shared<Capture::Content>();
    if (!polygons_) {
      content->panel = lookup_.picture(state, occupancy, coloring);
    }
    if (polygons_ || style_.vector) {
      content->walls =
          walls_.picture(state, occupancy, {.rule = ById{}, .palette = {kPaper}, .legend = {}});
      content->bodies = bodies_in_view(projection_, state, occupancy, coloring);
    }
    content->legend = coloring.legend;
    // The floor and sides of the box are walls, too.
    add_walls(content->legend,
              {.standing = true, .moving = std::ranges::any_of(state.walls, moves)});
    return Capture(std::move(content));
  }

  Image rasterize(const Capture::Content& captured, const Caption& caption, const Overlay& overlay,
                  double turn) {
    Graphics graphics(style_.width, style_.height);
    const PixelBox& box = layout_.panel;
    const Image polygons =
        polygons_ ? means_over(captured.walls, polygons_(captured.bodies), style_.supersampling)
                  : Image();
    const Image& panel = polygons_ ? polygons : captured.panel;
    const bool bare = overlay.strokes.empty() && overlay.fade == 0 && turn == 0;
    draw(graphics, captured, caption, overlay, turn, [&] {
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

  std::vector<std::uint8_t> pdf(const Capture::Content& captured, const Caption& caption,
                                const Overlay& overlay, double turn) const {
    Graphics graphics(Graphics::Page::pdf, style_.width, style_.height);
    draw(graphics, captured, caption, overlay, turn, [&] { draw_panel(graphics, captured); });
    return graphics.pdf(fmt::format("{}: {}", caption.title, caption.detail));
  }

  const Style& style() const { return style_; }
  PictureView view() const { return {layout_.panel, layout_.scale}; }

 private:
  void require_match(const grains::State& state, const Coloring& coloring) const {
    if (state.lattice != lattice_ || state.kinds.size() != kind_count_) {
      throw std::invalid_argument("the painter was made for another lattice or other kinds");
    }
    const std::size_t colors = coloring.palette.size();
    if ((colors == 0 && !state.particles.empty()) || colors > kMaxShades) {
      throw std::invalid_argument("particles need a coloring of 1 to 32000 colours");
    }
  }

  /// The picture around what `draw_particles` draws into the panel.
  template <class DrawParticles>
  void draw(Graphics& graphics, const Capture::Content& captured, const Caption& caption,
            const Overlay& overlay, double turn, DrawParticles draw_particles) const {
    const PixelBox& box = layout_.panel;
    {
      const Graphics::Clip clip(graphics, box.x, box.y, box.width, box.height);
      graphics.move_into(box, turn);
      draw_particles();
      draw_overlay(graphics, overlay, panel_scale(), box, turn);
    }
    Legend legend = captured.legend;
    legend.fade = overlay.fade;
    annotate(graphics, layout_, caption, legend);
  }

  PanelScale panel_scale() const {
    return {projection_.corner, layout_.scale, layout_.panel.height};
  }

  /// As vector graphics, but for the walls: those are a picture with a pixel for each sample.
  void draw_panel(Graphics& graphics, const Capture::Content& captured) const {
    graphics.draw_image(captured.walls, 0, 0, layout_.panel.width, layout_.panel.height);
    const lattice::Rectangle box = whole_box(lattice_);
    // Cairo counts pixels to 8 million.
    const Eigen::Vector2d size(layout_.panel.width, layout_.panel.height);
    const auto in_panel = [&](double x, double y) -> Eigen::Vector2d {
      return panel_scale().pixel({x, y}).cwiseMax(-size).cwiseMin(2 * size);
    };
    const Eigen::Vector2d low = in_panel(box.left, box.top);
    const Eigen::Vector2d high = in_panel(box.right, box.bottom);
    const Graphics::Clip clip(graphics, low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
    draw_bodies(graphics, captured.bodies, outlines_, projection_, panel_scale());
  }

  Style style_;
  lattice::Lattice lattice_;
  Layout layout_;
  Projection projection_;
  std::size_t kind_count_;
  SiteLookup lookup_;
  SiteLookup walls_;               // with a pixel for each sample
  std::vector<Outline> outlines_;  // by kind
  PolygonPainter polygons_;        // none for the lookup
};

Painter::Painter(const Style& style, const lattice::Lattice& lattice,
                 const std::vector<grains::Kind>& kinds)
    : impl_(std::make_unique<Impl>(style, lattice, kinds)) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Capture Painter::capture(const grains::State& state, const grains::Occupancy& occupancy,
                         const Coloring& coloring) {
  return impl_->capture(state, occupancy, coloring);
}

Image Painter::rasterize(const Capture& captured, const Caption& caption, const Overlay& overlay,
                         double turn) {
  return impl_->rasterize(captured.content(), caption, overlay, turn);
}

std::vector<std::uint8_t> Painter::pdf(const Capture& captured, const Caption& caption,
                                       const Overlay& overlay, double turn) {
  return impl_->pdf(captured.content(), caption, overlay, turn);
}

double Painter::bytes_for(const Style& style, double particles, int captures) {
  const PictureSize size = picture_size(style.width, style.height, style.view, style.annotations);
  const double pixels = static_cast<double>(size.width) * size.height;
  // In Cairo, of the view in captures and lookup, of the picture; what the lookup remembers.
  double bytes = pixels * (4 + (captures + 2.0) * sizeof(Rgb) + sizeof(grains::Owner)) +
                 particles * 4 * sizeof(Sample);
  if (style.vector || style.drawing == Drawing::polygons) {
    // Of the walls in captures and lookup, on the canvas and as it is read.
    const double samples = pixels * style.supersampling * style.supersampling;
    bytes += samples * ((captures + 1.0) * sizeof(Rgb) + 2 * sizeof(Sample)) +
             particles * captures * static_cast<double>(sizeof(Body));
  }
  return bytes;
}

int Painter::width() const {
  return impl_->style().width;
}

int Painter::height() const {
  return impl_->style().height;
}

PictureView Painter::view() const {
  return impl_->view();
}

Image Painter::draw(const grains::State& state, const grains::Occupancy& occupancy,
                    const Coloring& coloring, const Caption& caption, const Overlay& overlay) {
  return rasterize(capture(state, occupancy, coloring), caption, overlay);
}

}  // namespace clca::render
