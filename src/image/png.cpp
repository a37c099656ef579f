#include "clca/image/png.hpp"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "clca/text/utf8.hpp"

namespace clca::image {

namespace {

static_assert(sizeof(Rgb) == 3, "libpng reads and writes rows of pixels as they are");

[[noreturn]] void refuse_file(const std::string& reason) {
  throw std::runtime_error("cannot read a PNG file: " + reason);
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
  const std::string_view rest = data.substr(std::min(end + 1, data.size()));
  if (type == "tEXt") {
    texts.emplace(keyword, from_latin1(rest));
  } else if (type == "iTXt" && rest.starts_with('\0')) {
    const std::size_t language = std::min(rest.find('\0', 2), rest.size());
    const std::size_t translated = rest.find('\0', language + 1);
    if (translated != std::string_view::npos) {
      texts.emplace(keyword, text::encode_utf8(text::decode_utf8(rest.substr(translated + 1))));
    }
  }
}

/// Throws unless all chunks are as long as they claim: libpng reserves what they claim.
PngText texts_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kHead = 8;      // length, type
  constexpr std::size_t kChecksum = 4;  // of what libpng has read
  if (bytes.size() < kSignature || png_sig_cmp(bytes.data(), 0, kSignature) != 0) {
    refuse_file("it is no PNG file");
  }
  PngText texts;
  bytes = bytes.subspan(kSignature);
  while (bytes.size() >= kHead + kChecksum) {
    const std::size_t length = png_get_uint_32(bytes.data());
    const std::string_view chunk(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view type = chunk.substr(4, 4);
    if (type == "IEND") {
      return texts;
    }
    if (length > bytes.size() - kHead - kChecksum) {
      break;
    }
    add_text(texts, type, chunk.substr(kHead, length));
    bytes = bytes.subspan(kHead + length + kChecksum);
  }
  refuse_file("it is cut off");
}

/// Writes iTXt chunks, not compressed, without language and translated keyword.
std::vector<std::uint8_t> text_chunks(const PngText& text) {
  constexpr std::size_t kMaxKeyword = 79;
  std::vector<std::uint8_t> chunks;
  const auto add_number = [&chunks](std::size_t number) {
    for (const int shift : {24, 16, 8, 0}) {
      chunks.push_back(static_cast<std::uint8_t>(number >> shift));
    }
  };
  for (const auto& [keyword, value] : text) {
    const bool is_plain = std::ranges::all_of(keyword, [](char c) { return c > ' ' && c <= '~'; });
    if (!is_plain || keyword.empty() || keyword.size() > kMaxKeyword ||
        value.find('\0') != std::string::npos) {
      throw std::runtime_error("a PNG file cannot hold the text \"" + keyword + "\"");
    }
    std::string chunk = "iTXt";
    chunk.append(keyword).append(5, '\0').append(value);
    add_number(chunk.size() - 4);
    chunks.insert(chunks.end(), chunk.begin(), chunk.end());
    const auto* bytes = reinterpret_cast<const Bytef*>(chunk.data());
    add_number(::crc32_z(0, bytes, chunk.size()));
  }
  return chunks;
}

}  // namespace

DecodedPng decode_png(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  constexpr std::size_t kMaxInflationRatio = 1040;  // times; deflate packs 1032 times at best
  constexpr std::size_t kPixelsPerByte = 8;         // of one bit
  PngText texts = texts_of(bytes);
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> image(&header, png_image_free);
  const auto require_no_error = [&header] {
    if (PNG_IMAGE_FAILED(header)) {
      refuse_file(static_cast<const char*>(header.message));
    }
  };
  png_image_begin_read_from_memory(&header, bytes.data(), bytes.size());
  require_no_error();
  const std::size_t count = std::size_t{header.width} * header.height;
  if (count > max_pixels) {
    throw std::runtime_error(
        "the picture in a PNG file is too large: " + std::to_string(header.width) + " x " +
        std::to_string(header.height) + " pixels");
  }
  if (count > bytes.size() * kMaxInflationRatio * kPixelsPerByte) {
    refuse_file("too short for its picture");
  }
  header.format = PNG_FORMAT_RGB;
  header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  Image result(static_cast<int>(header.width), static_cast<int>(header.height), Rgb{});
  constexpr png_color kWhite = {255, 255, 255};
  png_image_finish_read(&header, &kWhite, result.pixels.data(), 0, nullptr);
  require_no_error();
  return {.image = std::move(result), .text = std::move(texts)};
}

std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text) {
  constexpr std::size_t kHeader = 33;  // bytes of signature and IHDR
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  header.flags = PNG_IMAGE_FLAG_FAST;
  if (image.width < 1 || image.height < 1) {
    throw std::runtime_error("a PNG file cannot hold an empty picture");
  }
  const std::vector<std::uint8_t> chunks = text_chunks(text);
  std::vector<std::uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(header));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) ==
      0) {
    throw std::runtime_error(std::string("cannot write a PNG file: ") +
                             static_cast<const char*>(header.message));
  }
  bytes.resize(size);
  bytes.insert(bytes.begin() + kHeader, chunks.begin(), chunks.end());
  return bytes;
}

}  // namespace clca::image
