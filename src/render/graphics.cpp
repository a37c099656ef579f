#include "render/graphics.hpp"

#include <cairo-pdf.h>
#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangocairo.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <numbers>
#include <set>
#include <system_error>
#include <thread>

#include "clca/text/utf8.hpp"
#include "render/colors.hpp"
#include "render/samples.hpp"

namespace clca::render {

void require_memory(std::size_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    throw std::bad_alloc();
  }
  ::munmap(room, bytes);
}

namespace {

// Of an arrow.
constexpr double kHeadLength = 4.0;   // in widths of the shaft
constexpr double kHeadShare = 0.65;   // of the whole arrow at most
constexpr double kHeadSlope = 0.42;   // half the head's width over its length
constexpr double kShaftShare = 0.45;  // of the head's width at most
constexpr double kDot = 0.7;          // diameter of an arrow that is too short, in widths

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;

void require_success(cairo_status_t status, int width, int height) {
  if (status == CAIRO_STATUS_NO_MEMORY) {
    throw std::bad_alloc();
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw RenderError(fmt::format("Cairo draws no picture of {} x {} pixels: {}", width, height,
                                  cairo_status_to_string(status)));
  }
}

Surface surface_of(int width, int height) {
  require_memory();
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  require_success(cairo_surface_status(surface.get()), width, height);
  return surface;
}

constexpr double kPoints = 0.75;  // of 1/72 inch in a pixel of a page

/// For Cairo. `pdf`: a std::vector of bytes.
cairo_status_t append(void* pdf, const unsigned char* bytes, unsigned count) {
  try {
    auto& whole = *static_cast<std::vector<std::uint8_t>*>(pdf);
    whole.insert(whole.end(), bytes, bytes + count);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

/// A page whose bytes go to the end of `pdf`.
Surface page_of(int width, int height, std::vector<std::uint8_t>& pdf) {
  require_memory();
  Surface surface(
      cairo_pdf_surface_create_for_stream(append, &pdf, kPoints * width, kPoints * height));
  require_success(cairo_surface_status(surface.get()), width, height);
  // The same page has the same bytes at any time.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  return surface;
}

Sample* row_of(cairo_surface_t* surface, int y) {
  return reinterpret_cast<Sample*>(cairo_image_surface_get_data(surface) +
                                   static_cast<std::ptrdiff_t>(y) *
                                       cairo_image_surface_get_stride(surface));
}

Surface surface_of(const Image& image) {
  Surface surface = surface_of(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    const Rgb* pixels = image.pixels.data() + std::ptrdiff_t{y} * image.width;
    std::transform(pixels, pixels + image.width, row_of(surface.get(), y), to_sample);
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

bool is_drawable(const Stroke& stroke) {
  constexpr double kFar = 1e6;  // pixels; Cairo counts to 8 million
  const auto near = [](double coordinate) { return std::abs(coordinate) < kFar; };  // false for NaN
  return near(stroke.from.x()) && near(stroke.from.y()) && near(stroke.to.x()) &&
         near(stroke.to.y()) && stroke.width > 0 && near(stroke.width);
}

/// Control characters are not drawn.
std::string printable(std::string_view text) {
  std::u32string letters = text::decode_utf8(text);
  for (char32_t& letter : letters) {
    letter = letter < U' ' || letter == 0x7F ? U' ' : letter;
  }
  return text::encode_utf8(letters);
}

void line_to(cairo_t* cairo, const Eigen::Vector2d& point) {
  cairo_line_to(cairo, point.x(), point.y());
}

void straight_line(cairo_t* cairo, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                   double width) {
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(cairo, width);
  line_to(cairo, from);
  line_to(cairo, to);
  cairo_stroke(cairo);
}

void arrow(cairo_t* cairo, const Stroke& stroke) {
  const Eigen::Vector2d whole = stroke.to - stroke.from;
  const double length = whole.norm();
  if (length < std::max(stroke.width, 1.0)) {
    const Eigen::Vector2d middle = (stroke.from + stroke.to) / 2;
    straight_line(cairo, middle, middle, kDot * stroke.width);
    return;
  }
  const double head = std::min(kHeadLength * stroke.width, kHeadShare * length);
  const double half_width = kHeadSlope * head;
  const Eigen::Vector2d along = whole / length;
  const Eigen::Vector2d across(-along.y() * half_width, along.x() * half_width);
  const Eigen::Vector2d base = stroke.to - head * along;
  straight_line(cairo, stroke.from, base, std::min(stroke.width, 2 * kShaftShare * half_width));
  for (const Eigen::Vector2d& corner :
       std::array<Eigen::Vector2d, 3>{base + across, stroke.to, base - across}) {
    line_to(cairo, corner);
  }
  cairo_fill(cairo);
}

/// The fonts of the system, for one thread at a time.
struct Fonts {
  std::recursive_mutex mutex;
  PangoFontMap* map = pango_cairo_font_map_new();  ///< to the end of the process
  std::set<double> sizes;                          ///< of text so far

  static Fonts& get() {
    static Fonts fonts;
    return fonts;
  }
};

/// Pango looks for fonts in two threads, and ends the program where it cannot start them.
bool two_threads_can_start() {
  try {
    const std::jthread first([] {});
    const std::jthread second([] {});
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text,
                             [](char letter) { return static_cast<unsigned char>(letter) < 0x80; });
}

/// Text without hinting, placed between pixels: the same shapes at each position.
PangoContext* font_context(cairo_t* cairo, PangoFontMap* fonts) {
  PangoContext* context = pango_font_map_create_context(fonts);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  pango_cairo_context_set_resolution(context, 72);
  pango_context_set_round_glyph_positions(context, FALSE);
  pango_cairo_update_context(cairo, context);
  return context;
}

double width_of(PangoLayout* layout) {
  PangoRectangle extents = {};
  pango_layout_get_extents(layout, nullptr, &extents);
  return pango_units_to_double(extents.width);
}

}  // namespace

Graphics::Graphics(int width, int height, Medium medium) : width_(width), height_(height) {
  const Surface surface =
      medium == Medium::page ? page_of(width, height, pdf_) : surface_of(width, height);
  cairo_.reset(cairo_create(surface.get()), cairo_destroy);
  if (medium == Medium::page) {
    cairo_scale(cairo_.get(), kPoints, kPoints);
  }
  set_color(kPaper);
  cairo_paint(cairo_.get());
}

std::vector<std::uint8_t> Graphics::pdf(const std::string& title) {
  cairo_surface_t* surface = cairo_get_target(cairo_.get());
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, printable(title).c_str());
  cairo_surface_finish(surface);
  require_success(cairo_surface_status(surface), width_, height_);
  return std::move(pdf_);
}

Image Graphics::image(const PixelBox& without) const {
  cairo_surface_t* surface = cairo_get_target(cairo_.get());
  cairo_surface_flush(surface);
  Image image(width_, height_, kPaper);
  for (int y = 0; y < height_; ++y) {
    if (y >= without.y && y < without.y + without.height) {
      continue;
    }
    std::transform(row_of(surface, y), row_of(surface, y) + width_, &image.at(0, y), to_rgb);
  }
  return image;
}

void Graphics::set_color(Rgb color) {
  cairo_set_source_rgb(cairo_.get(), color.red / 255.0, color.green / 255.0, color.blue / 255.0);
}

void Graphics::fill_box(double left, double top, double right, double bottom, Rgb color) {
  set_color(color);
  cairo_rectangle(cairo_.get(), left, top, right - left, bottom - top);
  cairo_fill(cairo_.get());
}

void Graphics::fill_gradient(double left, double top, double right, double bottom,
                             std::span<const Rgb> colors) {
  cairo_pattern_t* gradient = cairo_pattern_create_linear(left, 0, right, 0);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    cairo_pattern_add_color_stop_rgb(
        gradient, static_cast<double>(i) / static_cast<double>(colors.size() - 1),
        colors[i].red / 255.0, colors[i].green / 255.0, colors[i].blue / 255.0);
  }
  cairo_set_source(cairo_.get(), gradient);
  cairo_pattern_destroy(gradient);
  cairo_rectangle(cairo_.get(), left, top, right - left, bottom - top);
  cairo_fill(cairo_.get());
}

void Graphics::fill_polygon(std::span<const Eigen::Vector2d> corners, Rgb fill, double line,
                            Rgb outline) {
  cairo_save(cairo_.get());
  for (const Eigen::Vector2d& corner : corners) {
    line_to(cairo_.get(), corner);
  }
  cairo_close_path(cairo_.get());
  set_color(fill);
  cairo_fill_preserve(cairo_.get());
  cairo_clip_preserve(cairo_.get());
  set_color(outline);
  cairo_set_line_width(cairo_.get(), 2 * line);
  cairo_stroke(cairo_.get());
  cairo_restore(cairo_.get());
}

void Graphics::draw_stroke(const Stroke& stroke) {
  if (!is_drawable(stroke)) {
    return;
  }
  set_color(stroke.color);
  if (stroke.is_arrow) {
    arrow(cairo_.get(), stroke);
  } else {
    straight_line(cairo_.get(), stroke.from, stroke.to, stroke.width);
  }
}

void Graphics::fade(double share) {
  if (share > 0) {
    cairo_set_source_rgba(cairo_.get(), 1, 1, 1, std::min(share, 1.0));
    cairo_paint(cairo_.get());
  }
}

void Graphics::draw_image(const Image& image, double left, double top, double width,
                          double height) {
  const Surface surface = surface_of(image);
  draw_clipped(left, top, width, height, [&] {
    cairo_translate(cairo_.get(), left, top);
    cairo_scale(cairo_.get(), width / image.width, height / image.height);
    cairo_set_source_surface(cairo_.get(), surface.get(), 0, 0);
    cairo_pattern_set_extend(cairo_get_source(cairo_.get()), CAIRO_EXTEND_PAD);
    cairo_paint(cairo_.get());
  });
}

Graphics::Text Graphics::text(std::string_view text, double size, double room) {
  Text result;
  if (text.empty()) {
    return result;
  }
  Fonts& fonts = Fonts::get();
  if (!fonts_) {
    require_memory();
    fonts_lock_ = std::unique_lock(fonts.mutex);
    fonts_.reset(font_context(cairo_.get(), fonts.map), g_object_unref);
  }
  if (fonts.sizes.insert(size).second || !is_ascii(text)) {  // Pango may look for other fonts
    if (const std::string problem = font_warning(); !problem.empty()) {
      throw RenderError(problem);
    }
  }
  PangoLayout* layout = pango_layout_new(static_cast<PangoContext*>(fonts_.get()));
  result.layout_.reset(layout, g_object_unref);
  PangoFontDescription* font = pango_font_description_from_string("DejaVu Sans, Sans");
  pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
  pango_layout_set_single_paragraph_mode(layout, TRUE);
  pango_layout_set_auto_dir(layout, FALSE);  // the title begins on the left in every script
  const std::string letters = printable(text);
  pango_layout_set_text(layout, letters.data(), static_cast<int>(letters.size()));
  result.width_ = width_of(layout);
  if (result.width_ > room) {
    pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
    pango_layout_set_width(layout, static_cast<int>(std::max(room, 0.0) * PANGO_SCALE));
    result.width_ = width_of(layout);
    if (result.width_ > room) {
      return {};
    }
  }
  return result;
}

void Graphics::draw_text(const Text& text, double left, double baseline, Rgb color) {
  if (!text.layout_) {
    return;
  }
  set_color(color);
  auto* layout = static_cast<PangoLayout*>(text.layout_.get());
  const double ascent = pango_units_to_double(pango_layout_get_baseline(layout));
  cairo_move_to(cairo_.get(), left, std::round(baseline) - ascent);
  pango_cairo_show_layout(cairo_.get(), layout);
  cairo_new_path(cairo_.get());
}

void Graphics::draw_clipped(double left, double top, double width, double height,
                            const std::function<void()>& draw) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), left, top, width, height);
  cairo_clip(cairo_.get());
  draw();
  cairo_restore(cairo_.get());
}

void Graphics::move_into(const PixelBox& box, double turn) {
  cairo_translate(cairo_.get(), box.x, box.y);
  if (turn != 0) {
    cairo_translate(cairo_.get(), box.width / 2.0, box.height / 2.0);
    cairo_rotate(cairo_.get(), -turn * std::numbers::pi / 180);
    cairo_translate(cairo_.get(), -box.width / 2.0, -box.height / 2.0);
  }
}

Image resized(const Image& image, int width, int height) {
  Graphics graphics(width, height);
  graphics.draw_image(image, 0, 0, width, height);
  return graphics.image();
}

void paste(const Image& image, Image& picture, int left, int top) {
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(image.pixels.data() + std::ptrdiff_t{y} * image.width, image.width,
                &picture.at(left, top + y));
  }
}

Image cropped(const Image& image, const PixelBox& box) {
  Image result(box.width, box.height, {});
  for (int y = 0; y < box.height; ++y) {
    std::copy_n(image.pixels.data() + std::ptrdiff_t{box.y + y} * image.width + box.x, box.width,
                &result.at(0, y));
  }
  return result;
}

std::string font_warning() {
  require_memory();  // fontconfig and Pango end the program where there is none
  const FcFontSet* fonts = FcConfigGetFonts(nullptr, FcSetSystem);
  if (fonts == nullptr || fonts->nfont == 0) {
    return "no font for captions and legends: install DejaVu Sans (fonts-dejavu-core)";
  }
  return two_threads_can_start()
             ? ""
             : "no captions and legends: their text needs two threads, and none can be started";
}

}  // namespace clca::render
