#include "clca/render/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "clca/render/area_filter.hpp"
#include "clca/render/painter.hpp"
#include "render/colors.hpp"
#include "render/font.hpp"
#include "render/marks.hpp"

namespace clca::render {

namespace {

constexpr Rgb kMissing = {236, 238, 240};
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28U;

// In text sizes.
constexpr double kGap = 1.2;
constexpr double kLabelStrip = 1.7;
constexpr double kTitleStrip = 2.6;
constexpr double kSheetTitleSize = 1.4;  // in text sizes

bool missing(const Image& image) {
  return image.width < 1 || image.height < 1;
}

int scaled_height(const Image& image, int cell_width) {
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(image.height) * cell_width /
                                                  image.width)));
}

/// Layout of the sheet, in pixels.
class Sheet {
 public:
  Sheet(const std::vector<LabelledImage>& images, int columns, int cell_width, bool titled)
      : columns_(std::min(columns, std::max(1, static_cast<int>(images.size())))),
        cell_width_(cell_width),
        text_size_(std::clamp(static_cast<int>(std::lround(cell_width / 20.0)), 9, 24)) {
    std::int64_t top = titled ? em(kTitleStrip) : em(kGap);
    // Height of a row without pictures: nine sixteenths of the width.
    int usual = std::max(1, cell_width / 16 * 9 + cell_width % 16 * 9 / 16);
    for (std::size_t first = 0; first < images.size();
         first += static_cast<std::size_t>(columns_)) {
      usual = row_height(images, first).value_or(usual);
      tops_.push_back(static_cast<int>(top));
      heights_.push_back(usual);
      top += usual + em(kLabelStrip) + em(kGap);
      require(width(), top);
    }
    require(width(), top);
    height_ = static_cast<int>(top);
  }

  std::int64_t width() const {
    return std::int64_t{columns_} * (cell_width_ + em(kGap)) + em(kGap);
  }
  int height() const { return height_; }
  int text_size() const { return text_size_; }
  int em(double text_sizes) const { return static_cast<int>(std::lround(text_sizes * text_size_)); }

  int left(std::size_t number) const {
    const auto column = static_cast<int>(number % static_cast<std::size_t>(columns_));
    return em(kGap) + column * (cell_width_ + em(kGap));
  }
  int top(std::size_t number) const { return tops_[row(number)]; }
  int row_height(std::size_t number) const { return heights_[row(number)]; }

 private:
  std::size_t row(std::size_t number) const { return number / static_cast<std::size_t>(columns_); }

  /// Height of the tallest picture of the row that starts with this one.
  std::optional<int> row_height(const std::vector<LabelledImage>& images, std::size_t first) const {
    std::optional<int> highest;
    const std::size_t end = std::min(first + static_cast<std::size_t>(columns_), images.size());
    for (std::size_t i = first; i < end; ++i) {
      if (!missing(images[i].image)) {
        highest = std::max(highest.value_or(1), scaled_height(images[i].image, cell_width_));
      }
    }
    return highest;
  }

  static void require(std::int64_t width, std::int64_t height) {
    if (height > kMaxPixels / width) {
      throw RenderError(
          fmt::format("a contact sheet of {} x {} pixels is too large", width, height));
    }
  }

  int columns_;
  int cell_width_;
  int text_size_;
  int height_ = 0;
  std::vector<int> tops_;
  std::vector<int> heights_;
};

void paste(const Image& image, int left, int top, Image& sheet) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      sheet.at(left + x, top + y) = image.at(x, y);
    }
  }
}

void draw_text(const std::vector<LabelledImage>& images, const Sheet& place, int cell_width,
               const std::string& title, Image& sheet) {
  Font font;
  font.set_size(kSheetTitleSize * place.text_size());
  const int left = place.em(kGap);
  font.draw(sheet, left, place.em(1.75), font.shortened(title, sheet.width - 2.0 * left), kInk);
  font.set_size(place.text_size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i].image;
    const int height = missing(image) ? place.row_height(i) : scaled_height(image, cell_width);
    const int baseline = place.top(i) + height + place.em(1.2);
    font.draw(sheet, place.left(i), baseline, font.shortened(images[i].label, cell_width), kInk);
  }
}

}  // namespace

Image contact_sheet(const std::vector<LabelledImage>& images, int columns, int cell_width,
                    const std::string& title) {
  if (columns < 1 || cell_width < 1) {
    throw std::invalid_argument("a contact sheet has columns at least one pixel wide");
  }
  const Sheet place(images, columns, cell_width, !title.empty());
  Image sheet(static_cast<int>(place.width()), place.height(), kPaper);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i].image;
    if (missing(image)) {
      fill_box(sheet, place.left(i), place.top(i), place.left(i) + cell_width,
               place.top(i) + place.row_height(i), kMissing);
    } else {
      paste(scaled(image, cell_width, scaled_height(image, cell_width)), place.left(i),
            place.top(i), sheet);
    }
  }
  if (font_problem().empty()) {
    draw_text(images, place, cell_width, title, sheet);
  }
  return sheet;
}

}  // namespace clca::render
