// Pictures: the files that a scene names, and walls from them or row by row.

#include <algorithm>
#include <map>
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

class PictureReader {
 public:
  explicit PictureReader(std::string folder) : folder_(std::move(folder)) {}

  void read_all(Value& value) {
    for (Value& item : value.items) {
      read_all(item);
    }
    for (Entry& entry : value.entries) {
      Value* file = entry.key == "picture" ? entry.value.find("file") : nullptr;
      if (file != nullptr && file->is(Value::Kind::scalar)) {
        read(*file);
      }
      read_all(entry.value);
    }
  }

 private:
  void read(Value& value) {
    constexpr std::size_t kPixelRowBytes = 14;  // beside the pixels, in the resolved scene
    std::shared_ptr<const PictureFile>& known = files_[absolute_path(folder_, value.text)];
    if (!known) {
      known = std::make_shared<const PictureFile>(read_file(absolute_path(folder_, value.text)));
    }
    const auto width = static_cast<std::size_t>(known->image.width);
    text_bytes_ += (width + kPixelRowBytes) * static_cast<std::size_t>(known->image.height);
    if (text_bytes_ > document::kMaxBytes) {
      fail(value.location, "with this picture the rows of all pictures are larger than {} MiB",
           document::kMaxBytes >> 20U);
    }
    value.attached = known;
  }

  PictureFile read_file(const std::string& file) {
    try {
      const auto bytes = text::read_file(file, std::min(kMaxPictureFileBytes, bytes_left_));
      bytes_left_ -= static_cast<double>(bytes.size());
      return {.image = image::decode_png(bytes, kMaxPicturePixels).image, .problem = {}};
    } catch (const std::runtime_error& error) {
      return {.image = {}, .problem = error.what()};
    }
  }

  std::string folder_;
  std::map<std::string, std::shared_ptr<const PictureFile>> files_;
  double bytes_left_ = 4 * kMaxPictureFileBytes;  // of all files of a scene
  std::size_t text_bytes_ = 0;
};

using lattice::Picture;
using Rows = std::vector<std::string>;

/// Darker than the grey in the middle; by the luma of Rec. 601.
bool is_dark(image::Rgb pixel) {
  constexpr int kMiddle = 128;
  return 299 * pixel.red + 587 * pixel.green + 114 * pixel.blue < 1000 * kMiddle;
}

void read_rows(const PlacedValue& fields, Picture& picture) {
  if (fields.find("file") != nullptr && fields.find("rows") == nullptr) {
    picture.rows = rows_of(read_picture(fields.at("file")), [](image::Rgb color) {
      return is_dark(color) ? Picture::kDark : Picture::kLight;
    });
  }
}

}  // namespace

void read_picture_files(Value& root, const std::string& folder) {
  PictureReader(folder).read_all(root);
}

Rows rows_of(const image::Image& image, const std::function<char(image::Rgb color)>& letter) {
  Rows rows;
  for (int y = 0; y < image.height; ++y) {
    std::string& row = rows.emplace_back();
    for (int x = 0; x < image.width; ++x) {
      row += letter(image.at(x, y));
    }
  }
  return rows;
}

const image::Image& read_picture(const PlacedValue& place) {
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
        list.in_lines = true;
        std::ranges::transform(rows, std::back_inserter(list.items), Value::quoted_text);
        return list;
      });
}

Type<Picture> picture_type() {
  const auto allowed = [](char pixel) {
    return pixel == Picture::kDark || pixel == Picture::kLight;
  };
  return type_of<Picture>(
      {.keys = {picture_file_key(read_rows),
                key("rows", &Picture::rows, rows_type(allowed, "the characters # and .", "^[#.]+$"),
                    "the same as text, from the top: `#` for dark pixels, `.` for others")
                    .with_condition("this or `file`"),
                required("box", &Picture::box, rectangle(), "what the picture covers")},
       .one_of = {"file", "rows"}});
}

}  // namespace clca::scene
