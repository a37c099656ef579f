#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "clca/image/png.hpp"
#include "image/png_error.hpp"

namespace clca::image {

namespace {

constexpr int kCompressionLevel = 2;   // many times faster than the default, hardly larger
constexpr int kCompressionMemory = 6;  // tables that stay in the cache

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return (static_cast<unsigned char>(c) & 0x80U) == 0; });
}

/// PNG specification, section 11.3.4.2: 1 to 79 Latin-1 letters, no space at the ends or twice.
bool is_keyword(std::string_view word) {
  return !word.empty() && word.size() <= 79 && word.front() != ' ' && word.back() != ' ' &&
         word.find("  ") == std::string_view::npos &&
         std::all_of(word.begin(), word.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

std::vector<png_text> text_chunks(const PngText& text) {
  std::vector<png_text> chunks;
  for (const auto& [keyword, value] : text) {
    if (!is_keyword(keyword) || value.find('\0') != std::string::npos) {
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
  const Image* image = nullptr;
  std::vector<png_text> text;
  std::vector<std::uint8_t> bytes;
  PngError error;
};

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* job = static_cast<WriteJob*>(png_get_io_ptr(png));
  bool full = false;
  try {
    job->bytes.insert(job->bytes.end(), data, data + size);
  } catch (const std::bad_alloc&) {
    full = true;
  }
  if (full) {
    png_error(png, "no memory for a PNG file");
  }
}

void no_flush(png_structp) {}

/// Returns false after an error. No object with a destructor may live here: errors long-jump.
bool write_png(png_structp png, png_infop info, WriteJob& job) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  const Image& image = *job.image;
  const auto width = static_cast<png_uint_32>(image.width);
  const auto height = static_cast<png_uint_32>(image.height);
  png_set_write_fn(png, &job, append, no_flush);
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
    png_write_row(png, &image.pixels[std::size_t{y} * width].red);
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text) {
  static_assert(sizeof(Rgb) == 3, "rows of pixels are handed to libpng as they are");
  if (image.width < 1 || image.height < 1) {
    throw std::runtime_error("a PNG file cannot hold an empty picture");
  }
  WriteJob job;
  job.image = &image;
  job.text = text_chunks(text);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job.error, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool done = info != nullptr && write_png(png, info, job);
  png_destroy_write_struct(&png, &info);
  if (!done) {
    throw std::runtime_error(job.error.message("cannot write a PNG file"));
  }
  return std::move(job.bytes);
}

}  // namespace clca::image
