#include "clca/render/contact_sheet.hpp"

#include <algorithm>

namespace clca::render {

namespace {

constexpr int kGap = 4;  // pixels
constexpr Rgb kPaper = {255, 255, 255};
constexpr Rgb kEmpty = {235, 235, 235};

int cell_height(const std::vector<LabelledImage>& images, int cell_width) {
  int height = 1;
  for (const auto& [image, label] : images) {
    if (image.width > 0) {
      height = std::max(height, cell_width * image.height / image.width);
    }
  }
  return height;
}

void put(Image& sheet, const Image& image, int left, int top, int width, int height) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      sheet.at(left + x, top + y) =
          image.width == 0 ? kEmpty : image.at(x * image.width / width, y * image.height / height);
    }
  }
}

}  // namespace

Image contact_sheet(const std::vector<LabelledImage>& images, int columns, int cell_width,
                    const std::string& /*title*/) {
  const int height = cell_height(images, cell_width);
  const int count = static_cast<int>(images.size());
  const int rows = (count + columns - 1) / columns;
  Image sheet(columns * (cell_width + kGap), std::max(1, rows * (height + kGap)), kPaper);
  for (int i = 0; i < count; ++i) {
    put(sheet, images[static_cast<std::size_t>(i)].image, i % columns * (cell_width + kGap),
        i / columns * (height + kGap), cell_width, height);
  }
  return sheet;
}

}  // namespace clca::render
