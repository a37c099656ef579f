// A wall from a picture: from a PNG file, or row by row.

#include <algorithm>

#include "clca/text/message.hpp"
#include "scene/document.hpp"
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
             [](const KeyedMap& fields, Picture& picture, const Scene& scene) {
               constexpr std::array<std::string_view, 2> kSources = {"file", "rows"};
               fields.only(kSources);
               if (const Value* value = fields.find("file")) {
                 picture.rows = rows_of(read_picture(*value, fields.path("file"), scene));
               }
             })
      .with_condition("this or `rows`");
}

}  // namespace

const image::Image& read_picture(const Value& value, const std::string& path, const Scene& scene) {
  const std::string file = file_path_type().read(value, path, scene);
  if (!value.picture->problem.empty()) {
    fail(value.location, fmt::format("{}: cannot read {}: {}", path, text::printable(file),
                                     text::printable(value.picture->problem)));
  }
  return value.picture->image;
}

Type<Rows> rows_type(bool (*allowed)(char letter), const std::string& about,
                     const std::string& pattern) {
  return own_type<Rows>(
      "list of texts", with(array_schema(text_schema(pattern)), "minItems", 1),
      [=](const Value& value, const std::string& path, const Scene& /*scene*/) {
        Rows rows;
        std::size_t pixels = 0;
        for (const Value& item : read_list(value, path, 1, kMaxPicturePixels)) {
          const std::string& row = rows.emplace_back(read_text(item, path));
          if (row.empty() || row.size() != rows.front().size() ||
              !std::all_of(row.begin(), row.end(), allowed)) {
            fail(item.location, fmt::format("{}: expected rows of one length of {}, found {}", path,
                                            about, found(item)));
          }
          pixels += row.size();
        }
        if (pixels > kMaxPicturePixels) {
          fail(value.location, fmt::format("{}: expected at most {} pixels, found {}", path,
                                           kMaxPicturePixels, pixels));
        }
        return rows;
      },
      [](const Rows& rows, const Scene& /*scene*/) {
        Yaml list = Yaml::list({});
        list.in_lines = true;
        std::transform(rows.begin(), rows.end(), std::back_inserter(list.items), quoted_text);
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
       .conditions = R"({"oneOf": [{"required": ["file"]}, {"required": ["rows"]}]})"});
}

}  // namespace clca::scene
