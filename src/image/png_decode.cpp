#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "clca/image/png.hpp"
#include "clca/text/utf8.hpp"
#include "image/png_error.hpp"

namespace clca::image {

namespace {

constexpr png_uint_32 kMaxSide = 1U << 20U;
constexpr std::size_t kMaxTextBytes = 1U << 22U;
constexpr png_uint_32 kMaxTexts = 16;
constexpr std::array<png_byte, 15> kTextChunks = {'t', 'E',  'X', 't', '\0', 'z', 'T', 'X',
                                                  't', '\0', 'i', 'T', 'X',  't', '\0'};
constexpr std::size_t kMaxInflationRatio = 1040;  // times; deflate packs 1032 times at best

/// All memory that libpng reads or writes; resized only outside of its calls.
struct ReadJob {
  std::span<const std::uint8_t> bytes;
  bool with_text = true;
  std::size_t position = 0;
  std::vector<png_byte> rgba;
  std::vector<png_bytep> rows;
  PngError error;
};

void take(png_structp png, png_bytep data, png_size_t size) {
  auto* job = static_cast<ReadJob*>(png_get_io_ptr(png));
  if (size > job->bytes.size() - job->position) {
    png_error(png, "the file ends too soon");
  }
  std::memcpy(data, job->bytes.data() + job->position, size);
  job->position += size;
}

/// libpng allocates the claimed size of a chunk before reading it, so no chunk may claim more than
/// the file has. libpng checks the rest.
void require_honest_chunks(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kFrame = 12;  // length, name, checksum
  std::size_t position = kSignature;
  while (position + kFrame <= bytes.size()) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = (length << 8U) | bytes[position + i];
    }
    if (length > bytes.size() - position - kFrame) {
      throw std::runtime_error("cannot read a PNG file: it is cut off or no PNG file");
    }
    position += kFrame + length;
  }
}

/// Returns false after an error. No object with a destructor may live here: errors long-jump.
bool read_header(png_structp png, png_infop info, ReadJob& job) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_user_limits(png, kMaxSide, kMaxSide);
  png_set_chunk_malloc_max(png, std::min(kMaxTextBytes, kMaxInflationRatio * job.bytes.size()));
  png_set_chunk_cache_max(png, kMaxTexts);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // such as profiles
  if (job.with_text) {
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, kTextChunks.data(), 3);
  }
  png_set_read_fn(png, &job, take);
  png_read_info(png, info);
  return true;
}

/// The same for the pixels: reads RGBA8 into job.rows.
bool read_pixels(png_structp png, png_infop info, ReadJob& job) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) * job.rows.size() != job.rgba.size()) {
    png_error(png, "unexpected layout of pixels");
  }
  png_read_image(png, job.rows.data());
  png_read_end(png, info);
  return true;
}

/// Allocates the pixels once the file is known to be large enough for them.
void reserve(png_structp png, png_infop info, std::size_t max_pixels, ReadJob& job) {
  const std::size_t width = png_get_image_width(png, info);
  const std::size_t height = png_get_image_height(png, info);
  if (width > max_pixels / height) {
    throw std::runtime_error("the picture in a PNG file is too large: " + std::to_string(width) +
                             " x " + std::to_string(height) + " pixels");
  }
  if (png_get_rowbytes(png, info) > job.bytes.size() * kMaxInflationRatio / height) {
    throw std::runtime_error("cannot read a PNG file: too short for its picture");
  }
  job.rgba.resize(4 * width * height);
  job.rows.resize(height);
  for (std::size_t y = 0; y < height; ++y) {
    job.rows[y] = job.rgba.data() + 4 * width * y;
  }
}

Image on_white(png_structp png, png_infop info, const std::vector<png_byte>& rgba) {
  Image image(static_cast<int>(png_get_image_width(png, info)),
              static_cast<int>(png_get_image_height(png, info)), Rgb{});
  const png_byte* from = rgba.data();
  for (Rgb& pixel : image.pixels) {
    const unsigned alpha = from[3];
    const auto mixed = [alpha](unsigned channel) {
      return static_cast<std::uint8_t>((channel * alpha + 255 * (255 - alpha) + 127) / 255);
    };
    pixel = {mixed(from[0]), mixed(from[1]), mixed(from[2])};
    from += 4;
  }
  return image;
}

std::string from_latin1(std::string_view text) {
  std::u32string letters;
  for (const char letter : text) {
    letters.push_back(static_cast<unsigned char>(letter));
  }
  return text::encode_utf8(letters);
}

PngText text_of(png_structp png, png_infop info) {
  png_textp chunks = nullptr;
  int count = 0;
  png_get_text(png, info, &chunks, &count);
  PngText text;
  for (int i = 0; i < count; ++i) {
    const png_text& chunk = chunks[i];
    if (chunk.key == nullptr || chunk.text == nullptr) {
      continue;
    }
    const bool utf8 = chunk.compression >= PNG_ITXT_COMPRESSION_NONE;
    text.emplace(from_latin1(chunk.key),
                 utf8 ? text::encode_utf8(text::decode_utf8(chunk.text)) : from_latin1(chunk.text));
  }
  return text;
}

/// Frees what libpng has allocated.
struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;

  explicit Reader(ReadJob& job)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &job.error, fail, ignore)),
        info(png == nullptr ? nullptr : png_create_info_struct(png)) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

}  // namespace

std::optional<PixelBox> png_size(std::span<const std::uint8_t> bytes) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    return std::nullopt;
  }
  const PixelBox size = {0, 0, static_cast<int>(image.width), static_cast<int>(image.height)};
  png_image_free(&image);
  return size;
}

namespace {

DecodedPng decoded(std::span<const std::uint8_t> bytes, std::size_t max_pixels, bool with_text) {
  require_honest_chunks(bytes);
  ReadJob job;
  job.bytes = bytes;
  job.with_text = with_text;
  const Reader reader(job);
  const auto require = [&](bool done) {
    if (!done) {
      throw std::runtime_error(job.error.message("cannot read a PNG file"));
    }
  };
  require(reader.info != nullptr && read_header(reader.png, reader.info, job));
  reserve(reader.png, reader.info, max_pixels, job);
  require(read_pixels(reader.png, reader.info, job));
  return {on_white(reader.png, reader.info, job.rgba), text_of(reader.png, reader.info)};
}

}  // namespace

DecodedPng decode_png(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  return decoded(bytes, max_pixels, true);
}

Image decode_pixels(std::span<const std::uint8_t> bytes, std::size_t max_pixels) {
  return decoded(bytes, max_pixels, false).image;
}

}  // namespace clca::image
