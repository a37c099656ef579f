#include "clca/render/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "clca/render/painter.hpp"
#include "render/annotations.hpp"
#include "render/colors.hpp"
#include "render/graphics.hpp"

namespace clca::render {

namespace {

constexpr Rgb kMissing = {236, 238, 240};
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28U;
constexpr double kTallest = 1.4;  // height of a view in widths of its cell

// In text sizes.
constexpr double kSheetGap = 1.2;
constexpr double kLabelStrip = 1.7;
constexpr double kNextLine = 1.3;
constexpr double kTitleStrip = 2.6;
constexpr double kSheetTitleSize = 1.4;
constexpr double kLegendStrip = 2.95;
constexpr double kOwnLegendSize = 0.7;

bool is_missing(const Tile& tile) {
  return tile.view_image.width < 1 || tile.view_image.height < 1;
}

/// None where the pictures have different ones.
std::optional<Legend> legend_of_all(const std::vector<Tile>& tiles) {
  std::optional<Legend> legend;
  for (const Tile& tile : tiles) {
    if (!is_missing(tile)) {
      legend = legend ? common_legend(*legend, tile.legend) : tile.legend;
      if (!legend) {
        return std::nullopt;
      }
    }
  }
  return legend.value_or(Legend());
}

/// A label in lines that fit into `room`, as far as it has commas to end them.
std::vector<std::string> in_lines(const std::string& label, double size, double room) {
  Graphics graphics(1, 1);
  std::vector<std::string> lines = {""};
  for (std::size_t start = 0; start < label.size();) {
    const std::size_t comma = label.find(", ", start);
    const std::size_t end = comma == std::string::npos ? label.size() : comma + 2;
    const std::string part = label.substr(start, end - start);
    if (!lines.back().empty() && graphics.text(lines.back() + part, size).width() > room) {
      lines.emplace_back();
    }
    lines.back() += part;
    start = end;
  }
  return lines;
}

class Sheet {
 public:
  Sheet(const std::vector<Tile>& tiles, int columns, int cell_width, bool titled)
      : tiles_(tiles),
        columns_(static_cast<std::size_t>(
            std::clamp(columns, 1, std::max(1, static_cast<int>(tiles.size()))))),
        cell_width_(cell_width),
        text_size_(std::clamp(std::round(cell_width / 20.0), 9.0, 24.0)),
        own_text_size_(std::max(9.0, std::round(kOwnLegendSize * text_size_))),
        has_font_(font_warning().empty()),
        legend_(legend_of_all(tiles)) {
    std::size_t lines = 1;
    for (const Tile& tile : tiles) {
      labels_.push_back(has_font_ ? in_lines(tile.label, text_size_, cell_width_)
                                  : std::vector<std::string>());
      lines = std::max(lines, labels_.back().size());
    }
    const double strip = kLabelStrip + kNextLine * static_cast<double>(lines - 1);
    double top = em(titled ? kTitleStrip : kSheetGap);
    double height = cell_width * 9.0 / 16;  // of a row without pictures
    for (std::size_t first = 0; first < tiles.size(); first += columns_) {
      double highest = 0;
      for (std::size_t i = first; i < std::min(first + columns_, tiles.size()); ++i) {
        highest = std::max(highest, is_missing(tiles[i]) ? 0 : tile_height(tiles[i]));
      }
      height = highest > 0 ? highest : height;
      tops_.push_back(top);
      heights_.push_back(height);
      top += height + em(strip) + em(kSheetGap);
    }
    height_ = top + (legend_ && *legend_ != Legend() ? em(kLegendStrip) : 0);
    if (!(width() * height_ <= static_cast<double>(kMaxPixels))) {
      throw RenderError(
          fmt::format("a contact sheet of {:.0f} x {:.0f} pixels is too large", width(), height_));
    }
  }

  Image drawn(const std::string& title) const {
    Graphics graphics(static_cast<int>(width()), static_cast<int>(height_));
    const double room = width() - 2 * em(kSheetGap);
    draw_text(graphics, title, kSheetTitleSize * text_size_, room, em(kSheetGap), em(1.75));
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const double left =
          em(kSheetGap) + static_cast<double>(i % columns_) * (cell_width_ + em(kSheetGap));
      double baseline =
          draw_tile(graphics, tiles_[i], left, tops_[i / columns_], heights_[i / columns_]) +
          em(1.2);
      for (const std::string& line : labels_[i]) {
        draw_text(graphics, line, text_size_, cell_width_, left, baseline);
        baseline += em(kNextLine);
      }
    }
    if (legend_) {
      const auto shown = std::ranges::find_if_not(tiles_, is_missing);
      draw_legend(graphics, *legend_, shown == tiles_.end() ? 1 : shown->pixels_per_spacing,
                  em(kSheetGap), height_ - em(kLegendStrip) - em(kSheetGap), room, text_size_);
    }
    return graphics.image();
  }

 private:
  double em(double text_sizes) const { return std::round(text_sizes * text_size_); }
  double width() const {
    return static_cast<double>(columns_) * (cell_width_ + em(kSheetGap)) + em(kSheetGap);
  }
  double tile_height(const Tile& tile) const {
    return tile.view_image.height + (legend_ ? 0 : std::round(kLegendStrip * own_text_size_));
  }

  void draw_text(Graphics& graphics, const std::string& text, double size, double room, double left,
                 double baseline) const {
    if (has_font_) {
      graphics.draw_text(graphics.text(text, size, room), left, baseline, kInk);
    }
  }

  void draw_legend(Graphics& graphics, const Legend& legend, double scale, double left, double top,
                   double room, double text_size) const {
    const auto pixels = [](double length) { return static_cast<int>(length); };
    if (has_font_) {
      annotate(graphics,
               {.panel = {pixels(left), pixels(top), pixels(room), 0},
                .pixels_per_spacing = scale,
                .text_size = pixels(text_size),
                .text_left = pixels(left),
                .text_right = pixels(left + room),
                .has_captions = false,
                .has_scale_bar = false},
               {}, legend);
    }
  }

  /// Returns where it ends.
  double draw_tile(Graphics& graphics, const Tile& tile, double left, double top,
                   double height) const {
    double bottom = top + height;
    if (is_missing(tile)) {
      graphics.fill_box(left, top, left + cell_width_, bottom, kMissing);
    } else {
      bottom = top + tile_height(tile);
      const double inset = std::floor((cell_width_ - tile.view_image.width) / 2.0);
      graphics.draw_image(tile.view_image, left + inset, top, tile.view_image.width,
                          tile.view_image.height);
      if (!legend_) {
        draw_legend(graphics, tile.legend, tile.pixels_per_spacing, left,
                    top + tile.view_image.height, cell_width_, own_text_size_);
      }
    }
    return bottom;
  }

  const std::vector<Tile>& tiles_;
  std::size_t columns_;
  int cell_width_;
  double text_size_;
  double own_text_size_;  // of the legend of a tile
  bool has_font_;
  std::optional<Legend> legend_;                  // of all tiles
  std::vector<std::vector<std::string>> labels_;  // in lines, of each tile; none without a font
  double height_ = 0;
  std::vector<double> tops_;  // of rows
  std::vector<double> heights_;
};

}  // namespace

int cell_width(int columns) {
  constexpr int kSheet = 1920;
  return std::clamp(kSheet / columns, 240, 640);
}

PixelBox tile_size(double view_width, double view_height, int width) {
  const double scale = std::min(width / view_width, kTallest * width / view_height);
  const auto pixels = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(scale * length)));
  };
  return {.width = pixels(view_width), .height = pixels(view_height)};
}

Tile tile(const Image& picture, const PictureView& view, int width) {
  const PixelBox& box = view.box;
  const PixelBox size = tile_size(box.width, box.height, width);
  return {.view_image = resized(cropped(picture, box), size.width, size.height),
          .pixels_per_spacing = view.pixels_per_spacing * size.width / box.width};
}

Image side_by_side(const std::vector<Image>& pictures) {
  int width = 0;
  int height = 0;
  for (const Image& picture : pictures) {
    width += picture.width;
    height = std::max(height, picture.height);
  }
  Image row(width, height, kPaper);
  int left = 0;
  for (const Image& picture : pictures) {
    paste(picture, row, left, 0);
    left += picture.width;
  }
  return row;
}

Image contact_sheet(const std::vector<Tile>& tiles, int columns, int cell_width,
                    const std::string& title) {
  if (columns < 1 || cell_width < 1) {
    throw std::invalid_argument("a contact sheet has columns at least one pixel wide");
  }
  return Sheet(tiles, columns, cell_width, !title.empty()).drawn(title);
}

}  // namespace clca::render
