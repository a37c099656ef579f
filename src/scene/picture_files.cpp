
#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "clca/image/png.hpp"
#include "clca/scene/parse.hpp"
#include "clca/text/read.hpp"
#include "document/internal/document.hpp"
#include "scene/limits.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

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
    std::shared_ptr<const PictureFile>& known = files_[file_at(folder_, value.text)];
    if (!known) {
      known = std::make_shared<const PictureFile>(read_file(file_at(folder_, value.text)));
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
      const auto bytes = text::read_file(file, std::min(kMaxPictureBytes, bytes_left_));
      bytes_left_ -= static_cast<double>(bytes.size());
      return {.image = image::decode_png(bytes, kMaxPicturePixels).image, .problem = {}};
    } catch (const std::runtime_error& error) {
      return {.image = {}, .problem = error.what()};
    }
  }

  std::string folder_;
  std::map<std::string, std::shared_ptr<const PictureFile>> files_;
  double bytes_left_ = kMaxAllPictureBytes;
  std::size_t text_bytes_ = 0;
};

}  // namespace

void read_picture_files(Value& root, const std::string& folder) {
  PictureReader(folder).read_all(root);
}

}  // namespace clca::scene
