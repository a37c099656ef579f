// Pictures: the files that a scene names, and walls from them or row by row.

#include <algorithm>
#include <stdexcept>

#include "clca/image/png.hpp"
#include "clca/scene/parse.hpp"
#include "clca/text/read.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kMaxPicturePixels = 1'000'000;  // of a wall
constexpr double kMaxPictureFileBytes = 1 << 24;

using lattice::Picture;
using Rows = std::vector<std::string>;

/// Darker than the grey in the middle; by the luma of Rec. 601.
bool is_dark(image::Rgb pixel) {
  constexpr int kMiddle = 128;
  return 299 * pixel.red + 587 * pixel.green + 114 * pixel.blue < 1000 * kMiddle;
}

image::Image read_image(const PlacedValue& place) {
  const std::string file = file_path_type().read(place);
  try {
    return image::decode_png(text::read_file(file, kMaxPictureFileBytes), kMaxPicturePixels).image;
  } catch (const std::runtime_error& error) {
    fail(place, "cannot read {}: {}", text::printable(file), text::printable(error.what()));
  }
}

/// In the resolved scene, about.
std::size_t bytes_of(const Rows& rows) {
  constexpr std::size_t kBesidePixels = 14;  // of a row
  return rows.empty() ? 0 : rows.size() * (rows.front().size() + kBesidePixels);
}

/// Of all pictures that have been read.
std::size_t bytes_of_rows(const Scene& scene) {
  std::size_t bytes = 0;
  for (const Wall& wall : scene.walls) {
    for (const WallPart& part : wall.parts) {
      const auto* picture = std::get_if<Picture>(&part);
      bytes += picture != nullptr ? bytes_of(picture->rows) : 0;
    }
  }
  for (const Stage& stage : scene.stages) {
    bytes += stage.fill && stage.fill->picture ? bytes_of(stage.fill->picture->rows) : 0;
  }
  return bytes;
}

void read_file_of_wall(const PlacedValue& fields, Picture& picture) {
  if (fields.find("file") != nullptr && fields.find("rows") == nullptr) {
    read_rows(fields.at("file"), picture.rows,
              [](image::Rgb color) { return is_dark(color) ? Picture::kDark : Picture::kLight; });
  }
}

}  // namespace

void read_rows(const PlacedValue& file, Rows& rows,
               const std::function<char(image::Rgb color)>& letter) {
  const image::Image image = read_image(file);
  for (int y = 0; y < image.height; ++y) {
    std::string& row = rows.emplace_back();
    for (int x = 0; x < image.width; ++x) {
      row += letter(image.at(x, y));
    }
  }
  if (bytes_of_rows(file.scene) > document::kMaxBytes) {
    fail(file.value.location, "with this picture the rows of all pictures are larger than {} MiB",
         document::kMaxBytes >> 20U);
  }
}

Type<Rows> rows_type(bool (*allowed)(char letter), const std::string& about,
                     const std::string& pattern) {
  return custom_type<Rows>(
      "list of texts", with(array_schema(text_schema(pattern)), R"("minItems": 1)"),
      [=](const PlacedValue& place) {
        Rows rows;
        std::size_t pixels = 0;
        for (const PlacedValue& item : read_list(place, 1, kMaxPicturePixels)) {
          const std::string& row = rows.emplace_back(read_text(item));
          if (row.empty() || row.size() != rows.front().size() ||
              !std::ranges::all_of(row, allowed)) {
            fail(item, "expected rows of one length of {}, found {}", about, found(item));
          }
          pixels += row.size();
        }
        if (pixels > kMaxPicturePixels) {
          fail(place, "expected at most {} pixels, found {}", kMaxPicturePixels, pixels);
        }
        return rows;
      },
      [](const Rows& rows) {
        Value list = Value::list();
        list.one_entry_per_line = true;
        std::ranges::transform(rows, std::back_inserter(list.items), Value::quoted_text);
        return list;
      });
}

Type<Picture> picture_type() {
  const auto allowed = [](char pixel) {
    return pixel == Picture::kDark || pixel == Picture::kLight;
  };
  return type_of<Picture>(
      {.keys = {picture_file_key(read_file_of_wall),
                key("rows", &Picture::rows, rows_type(allowed, "the characters # and .", "^[#.]+$"),
                    "the same as text, from the top: `#` for dark pixels, `.` for others")
                    .with_condition("this or `file`"),
                required_key("box", &Picture::box, rectangle_type(), "what the picture covers")},
       .one_of = {"file", "rows"}});
}

}  // namespace clca::scene
