#include <png.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "clca/image/png.hpp"
#include "clca/text/utf8.hpp"

namespace clca::image {

namespace {

using Bytes = std::span<const std::uint8_t>;

std::string_view as_text(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A header that has been read. Freed at the end.
std::unique_ptr<png_image, void (*)(png_image*)> opened(png_image& image, Bytes bytes) {
  image = {};
  image.version = PNG_IMAGE_VERSION;
  png_image_begin_read_from_memory(&image, bytes.data(), bytes.size());
  return {&image, png_image_free};
}

void require_no_error(const png_image& image) {
  if (PNG_IMAGE_FAILED(image)) {
    throw std::runtime_error(std::string("cannot read a PNG file: ") +
                             static_cast<const char*>(image.message));
  }
}

Image pixels_of(Bytes bytes, std::size_t max_pixels) {
  constexpr std::size_t kMaxInflationRatio = 1040;  // times; deflate packs 1032 times at best
  constexpr std::size_t kPixelsPerByte = 8;         // of one bit
  png_image header;
  const auto image = opened(header, bytes);
  require_no_error(header);
  const std::size_t count = std::size_t{header.width} * header.height;
  if (count > max_pixels) {
    throw std::runtime_error(
        "the picture in a PNG file is too large: " + std::to_string(header.width) + " x " +
        std::to_string(header.height) + " pixels");
  }
  if (count > bytes.size() * kMaxInflationRatio * kPixelsPerByte) {
    throw std::runtime_error("cannot read a PNG file: too short for its picture");
  }
  header.format = PNG_FORMAT_RGB;
  header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  static_assert(sizeof(Rgb) == 3, "libpng writes rows of pixels as they are");
  Image result(static_cast<int>(header.width), static_cast<int>(header.height), Rgb{});
  constexpr png_color kWhite = {255, 255, 255};
  png_image_finish_read(image.get(), &kWhite, result.pixels.data(), 0, nullptr);
  require_no_error(header);
  return result;
}

std::string from_latin1(std::string_view text) {
  std::u32string letters;
  for (const char letter : text) {
    letters.push_back(static_cast<unsigned char>(letter));
  }
  return text::encode_utf8(letters);
}

/// PNG specification, section 11.3.4: keyword, 0, text in Latin-1; or keyword, 0, whether it is
/// compressed, method, language, 0, translated keyword, 0, text in UTF-8.
void add_text(PngText& texts, std::string_view type, std::string_view data) {
  const std::size_t end = std::min(data.find('\0'), data.size());
  const std::string keyword = from_latin1(data.substr(0, end));
  std::string_view rest = data.substr(std::min(end + 1, data.size()));
  if (type == "tEXt") {
    texts.emplace(keyword, from_latin1(rest));
  } else if (type == "iTXt" && rest.starts_with('\0')) {
    const std::size_t language = rest.find('\0', 2);
    const std::size_t translated =
        language == std::string_view::npos ? language : rest.find('\0', language + 1);
    if (translated != std::string_view::npos) {
      texts.emplace(keyword, text::encode_utf8(text::decode_utf8(rest.substr(translated + 1))));
    }
  }
}

/// Throws unless all chunks are as long as they claim: libpng reserves what they claim.
PngText texts_of(Bytes bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kHead = 8;      // length, type
  constexpr std::size_t kChecksum = 4;  // of what libpng has read
  if (bytes.size() < kSignature || png_sig_cmp(bytes.data(), 0, kSignature) != 0) {
    throw std::runtime_error("cannot read a PNG file: it is no PNG file");
  }
  PngText texts;
  bytes = bytes.subspan(kSignature);
  while (bytes.size() >= kHead + kChecksum) {
    const std::size_t length = png_get_uint_32(bytes.data());
    const std::string_view type = as_text(bytes.subspan(4, 4));
    if (type == "IEND") {
      return texts;
    }
    if (length > bytes.size() - kHead - kChecksum) {
      break;
    }
    add_text(texts, type, as_text(bytes.subspan(kHead, length)));
    bytes = bytes.subspan(kHead + length + kChecksum);
  }
  throw std::runtime_error("cannot read a PNG file: it is cut off");
}

}  // namespace

DecodedPng decode_png(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  PngText texts = texts_of(bytes);
  return {.image = pixels_of(bytes, max_pixels), .text = std::move(texts)};
}

}  // namespace clca::image
