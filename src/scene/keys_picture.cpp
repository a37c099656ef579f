// A wall from a picture: from a PNG file, or row by row.

#include <algorithm>

#include "clca/text/message.hpp"
#include "document/internal/document.hpp"
#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

using lattice::Picture;
using Rows = std::vector<std::string>;

/// Darker than the grey in the middle; by the luma of Rec. 601.
bool is_dark(image::Rgb pixel) {
  constexpr int kMiddle = 128;
  return 299 * pixel.red + 587 * pixel.green + 114 * pixel.blue < 1000 * kMiddle;
}

Rows rows_of(const image::Image& picture) {
  Rows rows;
  for (int y = 0; y < picture.height; ++y) {
    std::string& row = rows.emplace_back();
    for (int x = 0; x < picture.width; ++x) {
      row += is_dark(picture.at(x, y)) ? Picture::kDark : Picture::kLight;
    }
  }
  return rows;
}

bool is_wall_pixel(char pixel) {
  return pixel == Picture::kDark || pixel == Picture::kLight;
}

/// The key that stands for `rows`: a run folder has no other file.
Key<Picture> file_key() {
  return own_key<Picture>(
             described("file", file_path_type(),
                       "a PNG of up to 1000000 pixels; a relative path begins at the folder of the "
                       "scene"),
             [](const KeyedMap& fields, Picture& picture) {
               if (fields.find("file") != nullptr && fields.find("rows") == nullptr) {
                 picture.rows = rows_of(read_picture(fields.at("file")));
               }
             })
      .with_condition("this or `rows`");
}

}  // namespace

const image::Image& read_picture(const Place& place) {
  const std::string file = file_path_type().read(place);
  const auto& picture = *static_cast<const PictureFile*>(place.value.attached.get());
  if (!picture.problem.empty()) {
    fail(place, "cannot read {}: {}", text::printable(file), text::printable(picture.problem));
  }
  return picture.image;
}

Type<Rows> rows_type(bool (*allowed)(char letter), const std::string& about,
                     const std::string& pattern) {
  return own_type<Rows>(
      "list of texts", with(array_schema(text_schema(pattern)), "minItems", 1),
      [=](const Place& place) {
        Rows rows;
        std::size_t pixels = 0;
        for (const Place& item : read_list(place, 1, kMaxPicturePixels)) {
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
        list.in_lines = true;
        std::ranges::transform(rows, std::back_inserter(list.items), Value::quoted_text);
        return list;
      });
}

Type<Picture> picture_type() {
  return type_of<Picture>(
      {.keys = {file_key(),
                key("rows", &Picture::rows,
                    rows_type(is_wall_pixel, "the characters # and .", "^[#.]+$"),
                    "the same as text, from the top: `#` for dark pixels, `.` for others", {})
                    .with_condition("this or `file`"),
                required("box", &Picture::box, rectangle(), "what the picture covers")},
       .one_of = {"file", "rows"}});
}

}  // namespace clca::scene
