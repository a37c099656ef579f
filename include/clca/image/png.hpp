#pragma once
// PNG files in memory, with text chunks for provenance.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "clca/image/image.hpp"

namespace clca::image {

/// Keyword to text (UTF-8), as in the PNG specification.
using PngText = std::map<std::string, std::string>;

/// Throws std::runtime_error when libpng fails.
std::vector<std::uint8_t> encode_png(const Image& image, const PngText& text);

struct DecodedPng {
  Image image;
  PngText text;
};

/// Reads any PNG as RGB8 (alpha over white), with texts that are not compressed. Throws
/// std::runtime_error with the reason for invalid PNGs and pictures of more than `max_pixels`.
DecodedPng decode_png(std::span<const std::uint8_t> bytes, std::size_t max_pixels = 1U << 28U);

}  // namespace clca::image
