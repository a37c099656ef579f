#include "clca/render/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "render/annotations.hpp"
#include "render/canvas.hpp"
#include "render/colors.hpp"
#include "render/graphics.hpp"
#include "render/layout.hpp"
#include "render/polygon_painter.hpp"
#include "render/projection.hpp"
#include "render/site_lookup.hpp"
#include "render/wall_appearance.hpp"

namespace clca::render {

namespace {

void draw_overlay(Graphics& graphics, const Overlay& overlay, const PanelScale& panel) {
  graphics.fade(overlay.fade);
  for (const Stroke& stroke : overlay.strokes) {
    graphics.draw_stroke({panel.pixel(stroke.from), panel.pixel(stroke.to),
                          stroke.width * panel.scale, stroke.color, stroke.arrow});
  }
}

}  // namespace

struct Capture::Content {
  std::shared_ptr<const SampleGrid> samples;  ///< without particles where there are polygons
  std::optional<PolygonPainter::Instances> polygons;
  std::vector<Rgb> palette;
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
        projection_(
            projection_of(style_.view, layout_, style.supersampling, lattice, style_.height)),
        kind_count_(kinds.size()),
        canvas_(layout_.panel.width, layout_.panel.height, style.supersampling),
        lookup_(lattice, projection_, style.threads),
        grids_(projection_.width, projection_.height) {
    const Canvas::Session session(canvas_);
    canvas_.require_size(style_.width, style_.height, style.supersampling);
    polygons_.emplace(canvas_.gl(), lattice, kinds);
  }

  Capture capture(const grains::State& state, const grains::Occupancy& occupancy,
                  const Coloring& coloring) {
    require_match(state, coloring);
    auto content = std::make_shared<Capture::Content>();
    if (by_polygons(state)) {
      content->samples = backdrop(state, occupancy);
      content->polygons = polygons_->instances(projection_, state, occupancy, coloring);
    } else {
      const std::shared_ptr<SampleGrid> samples = grids_.take();
      lookup_.particles(state, occupancy, coloring, *samples);
      content->samples = samples;
    }
    content->palette = coloring.palette;
    content->legend = coloring.legend;
    // The floor and sides of the box are walls, too.
    add_walls(content->legend, {.standing = true, .moving = any_wall_moves(state)});
    return Capture(std::move(content));
  }

  Image rasterize(const Capture::Content& captured, const Caption& caption, const Overlay& overlay,
                  double turn) {
    Graphics graphics(style_.width, style_.height);
    parts_ = draw(graphics, captured, caption, overlay, turn, [&] {
      graphics.draw_image(rasterized_panel(captured), 0, 0, layout_.panel.width,
                          layout_.panel.height);
    });
    return graphics.image();
  }

  std::vector<std::uint8_t> pdf(const Capture::Content& captured, const Caption& caption,
                                const Overlay& overlay, double turn) const {
    Graphics graphics(Graphics::Page::pdf, style_.width, style_.height);
    draw(graphics, captured, caption, overlay, turn, [&] { draw_panel(graphics, captured); });
    return graphics.pdf(fmt::format("{}: {}", caption.title, caption.detail));
  }

  Image legend(const Caption& caption, const Legend& legend) const {
    Graphics graphics(style_.width, style_.height);
    const PictureParts parts = annotate(graphics, layout_, caption, legend);
    return legend_of(graphics.image(), parts);
  }

  const Style& style() const { return style_; }
  const PictureParts& parts() const { return parts_; }

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
  PictureParts draw(Graphics& graphics, const Capture::Content& captured, const Caption& caption,
                    const Overlay& overlay, double turn, DrawParticles draw_particles) const {
    const PixelBox& box = layout_.panel;
    {
      const Graphics::Panel panel(graphics, box.x, box.y, box.width, box.height, turn);
      draw_particles();
      draw_overlay(graphics, overlay, panel_scale());
    }
    Legend legend = captured.legend;
    legend.fade = overlay.fade;
    return annotate(graphics, layout_, caption, legend);
  }

  PanelScale panel_scale() const {
    return {projection_.corner, layout_.scale, layout_.panel.height};
  }

  /// As vector graphics, but for what was looked up: that is a picture with a pixel for each
  /// sample.
  void draw_panel(Graphics& graphics, const Capture::Content& captured) const {
    const PixelBox& panel = layout_.panel;
    const SampleGrid& samples = *captured.samples;
    const std::vector<Rgb> colors = colors_by_code(captured.palette, projection_.outline_strength);
    graphics.draw_image(mean_picture(projection_.width, projection_.height, 1,
                                     [&](int x, int y) { return colors[samples.at(x, y)]; }),
                        0, 0, panel.width, panel.height);
    if (captured.polygons) {
      const lattice::Rectangle box = whole_box(lattice_);
      // Cairo counts pixels to 8 million.
      const Eigen::Vector2d size(panel.width, panel.height);
      const auto in_panel = [&](double x, double y) -> Eigen::Vector2d {
        return panel_scale().pixel({x, y}).cwiseMax(-size).cwiseMin(2 * size);
      };
      const Eigen::Vector2d low = in_panel(box.left, box.top);
      const Eigen::Vector2d high = in_panel(box.right, box.bottom);
      const Graphics::Clip clip(graphics, low.x(), low.y(), high.x() - low.x(), high.y() - low.y());
      polygons_->draw(graphics, projection_, panel_scale(), *captured.polygons);
    }
  }

  bool by_polygons(const grains::State& state) const {
    if (style_.drawing != Drawing::automatic) {
      return style_.drawing == Drawing::polygons;
    }
    // Walls behind polygons are drawn by lookup, moving ones each time.
    if (any_wall_moves(state)) {
      return false;
    }
    // Both ways give the same picture. With llvmpipe on one thread a triangle costs as much as
    // about 32 lookup samples, but only in rasterize();
    // three quarters of a lookup are in capture(), which the simulation waits for. So polygons may
    // cost twice as much.
    constexpr std::size_t kSamplesPerTriangle = 16;
    const std::size_t samples =
        static_cast<std::size_t>(projection_.width) * static_cast<std::size_t>(projection_.height);
    return polygons_->need_at_most(samples / kSamplesPerTriangle, projection_, state);
  }

  /// Cached: walls rarely change, and their lookup costs as much as a full one.
  std::shared_ptr<const SampleGrid> backdrop(const grains::State& state,
                                             const grains::Occupancy& occupancy) {
    if (!backdrop_walls_ || !backdrop_walls_->match(state)) {
      const std::shared_ptr<SampleGrid> walls = grids_.take();
      lookup_.walls(state, occupancy, *walls);
      backdrop_ = walls;
      backdrop_walls_.emplace(state);
    }
    return backdrop_;
  }

  Image rasterized_panel(const Capture::Content& captured) {
    const SampleGrid& samples = *captured.samples;
    const std::vector<Rgb> colors = colors_by_code(captured.palette, projection_.outline_strength);
    const auto looked_up = [&](int x, int y) { return colors[samples.at(x, y)]; };
    if (!captured.polygons) {
      return mean_picture(layout_.panel.width, layout_.panel.height, style_.supersampling,
                          looked_up);
    }
    const Canvas::Session session(canvas_);
    draw_polygons(*captured.polygons);
    const std::span<const std::uint8_t> drawn = canvas_.read();
    return mean_picture(
        layout_.panel.width, layout_.panel.height, style_.supersampling, [&](int x, int y) {
          const std::size_t at =
              4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width()) +
                   static_cast<std::size_t>(x));
          return drawn[at + 3] == 0 ? looked_up(x, y)
                                    : Rgb{drawn[at], drawn[at + 1], drawn[at + 2]};
        });
  }

  /// Draws the polygons; the rest is transparent.
  void draw_polygons(const PolygonPainter::Instances& instances) {
    const Gl& gl = canvas_.gl();
    gl.Disable(GL_SCISSOR_TEST);
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    const SampleBox box = projection_.samples_in(whole_box(lattice_));
    gl.Scissor(box.x, box.y, box.width, box.height);
    gl.Enable(GL_SCISSOR_TEST);
    polygons_->draw(projection_, instances);
  }

  Style style_;
  lattice::Lattice lattice_;
  Layout layout_;
  Projection projection_;
  std::size_t kind_count_;
  // Changed by capture().
  std::shared_ptr<const SampleGrid> backdrop_;
  std::optional<WallsAppearance> backdrop_walls_;  // those of the backdrop
  // Changed by rasterize().
  Canvas canvas_;
  PictureParts parts_;  // of the last picture
  // Constant.
  SiteLookup lookup_;
  std::optional<PolygonPainter> polygons_;
  GridPool grids_;
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

Image Painter::legend(const Caption& caption, const Legend& legend) const {
  return impl_->legend(caption, legend);
}

double Painter::bytes_for(const Style& style, int captures) {
  const PictureSize size = picture_size(style.width, style.height, style.view, style.annotations);
  const double pixels = static_cast<double>(size.width) * size.height;
  // On the canvas and as it is read; in the captures and of the walls.
  const double sample = 2 * 4 + (captures + 1.0) * sizeof(SampleCode);
  const double pixel = 4 + 2 * sizeof(Rgb);  // in Cairo, of the view and of the picture
  return pixels * (style.supersampling * style.supersampling * sample + pixel);
}

int Painter::width() const {
  return impl_->style().width;
}

int Painter::height() const {
  return impl_->style().height;
}

const PictureParts& Painter::parts() const {
  return impl_->parts();
}

Image Painter::draw(const grains::State& state, const grains::Occupancy& occupancy,
                    const Coloring& coloring, const Caption& caption, const Overlay& overlay) {
  return rasterize(capture(state, occupancy, coloring), caption, overlay);
}

}  // namespace clca::render
