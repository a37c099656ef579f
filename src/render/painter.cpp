#include "clca/render/painter.hpp"

#include <algorithm>
#include <optional>

#include "render/annotations.hpp"
#include "render/canvas.hpp"
#include "render/colors.hpp"
#include "render/framing.hpp"
#include "render/layout.hpp"
#include "render/lookup_painter.hpp"
#include "render/polygon_painter.hpp"
#include "render/seen_walls.hpp"
#include "render/strokes.hpp"

namespace clca::render {

namespace {

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
             const Coloring& coloring, const Caption& caption, const Overlay& overlay) {
    require_match(state, occupancy, coloring);
    Image picture(style_.width, style_.height, kPaper);
    Image panel = draw_panel(state, occupancy, coloring.colors);
    draw_overlay(panel, overlay, projection_.corner, layout_.scale);
    paste(panel, layout_.panel, picture);
    if (annotator_) {
      annotator_->draw(picture, layout_, caption, coloring.legend, overlay.fade);
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
    // Behind polygons, walls are drawn by lookup, and those that move again and again.
    if (any_wall_moves(state)) {
      return false;
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
                    colors.first(state.particles.size()), moving_wall_sites(state));
    }
    return canvas_.read();
  }

  /// Walls rarely change, and drawing them costs as much as drawing everything by lookup.
  void draw_backdrop(const automaton::State& state, const automaton::Occupancy& occupancy) {
    if (backdrop_walls_ && backdrop_walls_->match(state)) {
      canvas_.restore_backdrop();
      return;
    }
    clear();
    lookup_->draw(projection_, whole_box(lattice_), occupancy, {}, moving_wall_sites(state));
    canvas_.keep_backdrop();
    backdrop_walls_.emplace(state);
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
  std::optional<SeenWalls> backdrop_walls_;  // those of the kept backdrop
  std::size_t kind_count_ = 0;
};

Painter::Painter(const Style& style, const lattice::Lattice& lattice,
                 const std::vector<automaton::Kind>& kinds)
    : impl_(std::make_unique<Impl>(style, lattice, kinds)) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

Image Painter::draw(const automaton::State& state, const automaton::Occupancy& occupancy,
                    const Coloring& coloring, const Caption& caption, const Overlay& overlay) {
  return impl_->draw(state, occupancy, coloring, caption, overlay);
}

}  // namespace clca::render
