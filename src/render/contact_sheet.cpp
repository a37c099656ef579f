#include "clca/render/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "clca/render/painter.hpp"
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
constexpr double kTitleStrip = 2.6;
constexpr double kSheetTitleSize = 1.4;

bool missing(const Image& image) {
  return image.width < 1 || image.height < 1;
}

/// Without white rows and columns at its sides; of width 0 if there is nothing else.
Image trimmed(const Image& image) {
  PixelBox box = {image.width, image.height, 0, 0};
  int right = 0;
  int bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) != kPaper) {
        box.x = std::min(box.x, x);
        box.y = std::min(box.y, y);
        right = std::max(right, x + 1);
        bottom = y + 1;
      }
    }
  }
  box.width = right - box.x;
  box.height = bottom - box.y;
  return box.width > 0 ? cropped(image, box) : Image();
}

/// Layout of the sheet, in pixels.
class Sheet {
 public:
  Sheet(const std::vector<Tile>& tiles, int columns, int cell_width, bool titled)
      : tiles_(tiles),
        columns_(static_cast<std::size_t>(
            std::min(columns, std::max(1, static_cast<int>(tiles.size()))))),
        cell_width_(cell_width),
        text_size_(std::clamp(std::round(cell_width / 20.0), 9.0, 24.0)),
        common_legend_(legend_of_all()) {
    double top = titled ? em(kTitleStrip) : em(kSheetGap);
    double usual = cell_width * 9.0 / 16;  // of a row without pictures
    for (std::size_t first = 0; first < tiles.size(); first += columns_) {
      usual = row_height(first).value_or(usual);
      tops_.push_back(top);
      heights_.push_back(usual);
      top += usual + em(kLabelStrip) + em(kSheetGap);
    }
    legend_top_ = top;
    height_ =
        common_legend_ == nullptr
            ? top
            : top +
                  scale_of(*common_legend_, width() - 2 * em(kSheetGap)) * common_legend_->height +
                  em(kSheetGap);
    if (!(width() * height_ <= static_cast<double>(kMaxPixels))) {
      throw RenderError(
          fmt::format("a contact sheet of {:.0f} x {:.0f} pixels is too large", width(), height_));
    }
  }

  Image drawn(const std::string& title) const {
    Graphics graphics(static_cast<int>(width()), static_cast<int>(height_));
    const bool letters = font_problem().empty();
    if (letters) {
      graphics.draw_text(
          graphics.text(title, kSheetTitleSize * text_size_, width() - 2 * em(kSheetGap)),
          em(kSheetGap), em(1.75), kInk);
    }
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const double left =
          em(kSheetGap) + static_cast<double>(i % columns_) * (cell_width_ + em(kSheetGap));
      draw_tile(graphics, tiles_[i], left, tops_[i / columns_], heights_[i / columns_], letters);
    }
    if (common_legend_ != nullptr) {
      draw_legend(graphics, *common_legend_, em(kSheetGap), legend_top_,
                  width() - 2 * em(kSheetGap));
    }
    return graphics.image();
  }

 private:
  double em(double text_sizes) const { return std::round(text_sizes * text_size_); }
  double width() const {
    return static_cast<double>(columns_) * (cell_width_ + em(kSheetGap)) + em(kSheetGap);
  }

  /// Where all pictures have the same legend.
  const Image* legend_of_all() const {
    const Image* legend = nullptr;
    for (const Tile& tile : tiles_) {
      if (!missing(tile.view) && legend != nullptr && tile.legend != *legend) {
        return nullptr;
      }
      legend = missing(tile.view) ? legend : &tile.legend;
    }
    return legend == nullptr || missing(*legend) ? nullptr : legend;
  }
  static double scale_of(const Image& legend, double room) {
    return std::min(1.0, room / legend.width);
  }
  bool has_own_legend(const Tile& tile) const {
    return common_legend_ == nullptr && !missing(tile.legend);
  }
  double tile_height(const Tile& tile) const {
    return tile.view.height +
           (has_own_legend(tile)
                ? std::ceil(scale_of(tile.legend, cell_width_) * tile.legend.height) + em(0.5)
                : 0);
  }
  /// Height of the tallest tile of the row that starts with this one.
  std::optional<double> row_height(std::size_t first) const {
    std::optional<double> highest;
    for (std::size_t i = first; i < std::min(first + columns_, tiles_.size()); ++i) {
      if (!missing(tiles_[i].view)) {
        highest = std::max(highest.value_or(1), tile_height(tiles_[i]));
      }
    }
    return highest;
  }

  static void draw_legend(Graphics& graphics, const Image& legend, double left, double top,
                          double room) {
    const double scale = scale_of(legend, room);
    graphics.draw_image(legend, left, top, scale * legend.width, scale * legend.height);
  }

  void draw_tile(Graphics& graphics, const Tile& tile, double left, double top, double height,
                 bool letters) const {
    double bottom = top + height;
    if (missing(tile.view)) {
      graphics.fill_box(left, top, left + cell_width_, bottom, kMissing);
    } else {
      bottom = top + tile_height(tile);
      const double inset = std::floor((cell_width_ - tile.view.width) / 2.0);
      graphics.draw_image(tile.view, left + inset, top, tile.view.width, tile.view.height);
      if (has_own_legend(tile)) {
        draw_legend(graphics, tile.legend, left, top + tile.view.height + em(0.5), cell_width_);
      }
    }
    if (letters) {
      graphics.draw_text(graphics.text(tile.label, text_size_, cell_width_), left, bottom + em(1.2),
                         kInk);
    }
  }

  const std::vector<Tile>& tiles_;
  std::size_t columns_;
  int cell_width_;
  double text_size_;
  const Image* common_legend_;
  double legend_top_ = 0;
  double height_ = 0;
  std::vector<double> tops_;
  std::vector<double> heights_;
};

}  // namespace

Tile tile(const Image& picture, const PictureParts& parts, int width, std::string label) {
  if (missing(picture)) {
    return {{}, {}, std::move(label)};
  }
  const PixelBox view =
      parts.view.width > 0 ? parts.view : PixelBox{0, 0, picture.width, picture.height};
  const double scale = std::min(static_cast<double>(width) / view.width,
                                kTallest * static_cast<double>(width) / view.height);
  const auto resized = [scale](int length) {
    return std::max(1, static_cast<int>(std::lround(scale * length)));
  };
  return {scaled(cropped(picture, view), resized(view.width), resized(view.height)),
          trimmed(legend_of(picture, parts)), std::move(label)};
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
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        row.at(left + x, y) = picture.at(x, y);
      }
    }
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
