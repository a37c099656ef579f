// A picture: refused, or the same once written and read again.

#include <stdexcept>

#include "clca/image/png.hpp"
#include "target.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace image = clca::image;

constexpr std::size_t kMaxPixels = 1U << 16U;

/// What may stand in a PNG file need not be what we write: text with odd keywords.
void require_same_again(const image::DecodedPng& decoded) {
  const image::DecodedPng again = image::decode_png(image::encode_png(decoded.image, {}));
  fuzz::require(again.image == decoded.image, "other pixels");
  for (const auto& [keyword, value] : decoded.text) {
    try {
      const auto bytes = image::encode_png(image::Image(1, 1, {}), {{keyword, value}});
      fuzz::require(image::decode_png(bytes).text.at(keyword) == value, "another text");
    } catch (const std::runtime_error&) {
      continue;
    }
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    require_same_again(image::decode_png({data, size}, kMaxPixels));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
