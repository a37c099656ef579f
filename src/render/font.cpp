#include "render/font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <array>
#include <cmath>

#include "clca/render/painter.hpp"
#include "clca/text/utf8.hpp"
#include "render/blend.hpp"

namespace clca::render {

namespace {

constexpr std::array kFontFiles = {
#ifdef CLCA_FONT
    CLCA_FONT,
#endif
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",    // Debian
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",  // Fedora
    "/usr/share/fonts/TTF/DejaVuSans.ttf",                // Arch
    "/usr/share/fonts/dejavu/DejaVuSans.ttf",
};

constexpr double kUnits = 64;  // FreeType counts in 1/64 pixel

void draw_bitmap(Image& image, int left, int top, const FT_Bitmap& bitmap, Rgb color) {
  for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
    const unsigned char* coverage = bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
    for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
      const int x = left + column;
      const int y = top + row;
      if (x >= 0 && x < image.width && y >= 0 && y < image.height) {
        blend(image.at(x, y), color, coverage[column]);
      }
    }
  }
}

/// Control characters are not drawn.
std::u32string printable(std::string_view text) {
  std::u32string result = text::decode_utf8(text);
  for (char32_t& letter : result) {
    letter = letter < U' ' || letter == 0x7F ? U' ' : letter;
  }
  return result;
}

}  // namespace

class Font::Impl {
 public:
  Impl() {
    if (FT_Init_FreeType(&library_) != 0) {
      throw RenderError("FreeType does not start");
    }
    for (const char* file : kFontFiles) {
      if (FT_New_Face(library_, file, 0, &face_) == 0) {
        return;
      }
    }
    FT_Done_FreeType(library_);
    throw RenderError("no font for captions and legends: install DejaVu Sans (fonts-dejavu-core)");
  }
  ~Impl() {
    FT_Done_Face(face_);
    FT_Done_FreeType(library_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void set_size(double pixels) {
    FT_Set_Char_Size(face_, 0, std::lround(pixels * kUnits), 72, 72);  // at 72 dpi, pixel = point
  }

  /// Calls `use` with the bitmap of each glyph (or only measures). Returns the final pen position.
  template <class Use>
  FT_Pos walk(FT_Pos pen, std::u32string_view text, FT_Int32 flags, Use use) {
    for (const char32_t letter : text) {
      FT_Vector shift = {pen & 63, 0};
      FT_Set_Transform(face_, nullptr, &shift);
      if (FT_Load_Char(face_, letter, FT_LOAD_NO_HINTING | flags) != 0) {
        continue;
      }
      use(static_cast<int>(pen >> 6), *face_->glyph);
      // Not glyph->advance, which some versions round to whole pixels.
      pen += (face_->glyph->linearHoriAdvance + (1 << 9)) >> 10;
    }
    return pen;
  }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

Font::Font() : impl_(std::make_unique<Impl>()) {}
Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

void Font::set_size(double pixels) {
  impl_->set_size(pixels);
}

double Font::width(std::string_view text) const {
  const auto pen = impl_->walk(0, printable(text), FT_LOAD_DEFAULT, [](int, const auto&) {});
  return static_cast<double>(pen) / kUnits;
}

void Font::draw(Image& image, double x, double baseline, std::string_view text, Rgb color) const {
  const int line = static_cast<int>(std::lround(baseline));
  impl_->walk(std::lround(x * kUnits), printable(text), FT_LOAD_RENDER,
              [&](int pen, const FT_GlyphSlotRec_& glyph) {
                draw_bitmap(image, pen + glyph.bitmap_left, line - glyph.bitmap_top, glyph.bitmap,
                            color);
              });
}

std::string Font::shortened(std::string_view text, double room) const {
  if (width(text) <= room) {
    return std::string(text);
  }
  std::u32string letters = text::decode_utf8(text);
  while (!letters.empty()) {
    letters.pop_back();
    while (!letters.empty() && letters.back() == U' ') {
      letters.pop_back();
    }
    std::string candidate = text::encode_utf8(letters + U'…');
    if (width(candidate) <= room) {
      return candidate;
    }
  }
  return {};
}

std::string font_problem() {
  try {
    const Font font;
    return {};
  } catch (const RenderError& error) {
    return error.what();
  }
}

}  // namespace clca::render
