#include "clca/image/png.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <memory>
#include <new>
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

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text,
                             [](char c) { return (static_cast<unsigned char>(c) & 0x80U) == 0; });
}

std::vector<png_text> text_chunks(const PngText& text) {
  std::vector<png_text> chunks;
  for (const auto& [keyword, value] : text) {
    if (!is_ascii(keyword) || (keyword + value).find('\0') != std::string::npos) {
      throw std::runtime_error("a PNG file cannot hold the text \"" + keyword + "\"");
    }
    png_text chunk = {};
    const bool ascii = is_ascii(value);
    chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<char*>(keyword.c_str());  // libpng only reads
    chunk.text = const_cast<char*>(value.c_str());
    chunk.text_length = ascii ? value.size() : 0;
    chunk.itxt_length = ascii ? 0 : value.size();
    chunks.push_back(chunk);
  }
  return chunks;
}

/// All data that libpng reads, built before the first call that may long-jump.
struct WriteJob {
  const Image& image;
  std::vector<png_text> text;
  std::vector<std::uint8_t> bytes = {};
  std::string error = "cannot write a PNG file: no memory";
};

/// Keeps the reason and long-jumps. Also of warnings: libpng would write other keywords than given.
[[noreturn]] void fail(png_structp png, png_const_charp reason) {
  static_cast<WriteJob*>(png_get_error_ptr(png))->error.assign("cannot write a PNG file: ") +=
      reason;
  png_longjmp(png, 1);
}

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* job = static_cast<WriteJob*>(png_get_io_ptr(png));
  bool full = false;
  try {
    job->bytes.insert(job->bytes.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    full = true;
  }
  if (full) {
    png_error(png, "no memory");
  }
}

/// Returns false after an error. No object with a destructor may live here: errors long-jump.
bool write_png(png_structp png, png_infop info, WriteJob& job) {
  constexpr int kCompressionLevel = 2;   // many times faster than the default, hardly larger
  constexpr int kCompressionMemory = 6;  // tables that stay in the cache
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  const auto width = static_cast<png_uint_32>(job.image.width);
  const auto height = static_cast<png_uint_32>(job.image.height);
  png_set_write_fn(png, &job, append, [](png_structp) {});
  png_set_compression_level(png, kCompressionLevel);
  png_set_compression_mem_level(png, kCompressionMemory);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!job.text.empty()) {
    png_set_text(png, info, job.text.data(), static_cast<int>(job.text.size()));
  }
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < height; ++y) {
    png_write_row(png, &job.image.pixels[std::size_t{y} * width].red);
  }
  png_write_end(png, info);
  return true;
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
  if (image.width < 1 || image.height < 1) {
    throw std::runtime_error("a PNG file cannot hold an empty picture");
  }
  WriteJob job = {.image = image, .text = text_chunks(text)};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, fail, fail);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool done = info != nullptr && write_png(png, info, job);
  png_destroy_write_struct(&png, &info);
  if (!done) {
    throw std::runtime_error(job.error);
  }
  return std::move(job.bytes);
}

}  // namespace clca::image
