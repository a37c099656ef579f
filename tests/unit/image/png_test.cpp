#include "clca/image/png.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace clca::image::png_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Bytes = std::vector<std::uint8_t>;

Image colorful(int width, int height) {
  Image image(width, height, {});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto channel = [&](int factor) {
        return static_cast<std::uint8_t>((x * factor + 7 * y) & 255);
      };
      image.at(x, y) = {channel(3), channel(5), channel(11)};
    }
  }
  return image;
}

Image few_colors(int width, int height) {
  Image image(width, height, {255, 255, 255});
  for (int i = 0; i < width * height; i += 3) {
    image.pixels[static_cast<std::size_t>(i)] = {static_cast<std::uint8_t>(i % 7), 0, 9};
  }
  return image;
}

TEST(Png, BringsBackPixelsAndText) {
  const PngText text = {{"Title", "flow, step 120"}, {"Author", "Ōgawa, Größe µ"}, {"Empty", ""}};
  const Image image = colorful(61, 47);
  const DecodedPng decoded = decode_png(encode_png(image, text));
  EXPECT_EQ(decoded.image, image);
  EXPECT_EQ(decoded.text, text);
}

TEST(Png, IsTheSameBytesEachTime) {
  EXPECT_EQ(encode_png(colorful(33, 9), {{"k", "v"}}), encode_png(colorful(33, 9), {{"k", "v"}}));
}

TEST(Png, RefusesWhatAFileCannotHold) {
  EXPECT_THROW(encode_png(Image(), {}), std::runtime_error);
  for (const std::string& keyword :
       {std::string(), std::string(80, 'k'), std::string(" k"), std::string("k "),
        std::string("a  b"), std::string("a\0b", 3), std::string("\x7f"), std::string("é")}) {
    EXPECT_THROW(encode_png(colorful(2, 2), {{keyword, "text"}}), std::runtime_error);
  }
  EXPECT_THROW(encode_png(colorful(2, 2), {{"key", std::string("a\0b", 3)}}), std::runtime_error);
}

TEST(Png, PutsTransparentPixelsOnWhite) {
  // 3 x 1 RGBA: red, red half transparent, nothing. Written with Python's zlib.
  const Bytes bytes = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
                       0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06,
                       0x00, 0x00, 0x00, 0x1b, 0xe0, 0x14, 0xb4, 0x00, 0x00, 0x00, 0x12, 0x49, 0x44,
                       0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xf0, 0x1f, 0x88, 0x1b, 0x18,
                       0x80, 0x00, 0x00, 0x1f, 0x70, 0x03, 0x7e, 0x8a, 0xd2, 0x66, 0xb0, 0x00, 0x00,
                       0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const Image image = decode_png(bytes).image;
  EXPECT_EQ(image.pixels,
            (std::vector<Rgb>{
                {255, 0, 0}, {255, 186, 186}, {255, 255, 255}}));  // mixed as light, not as numbers
}

TEST(Png, ReadsInterlacedSixteenBitGray) {
  // 2 x 1: 0x8000 and 0xffff.
  const Bytes bytes = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                       0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01,
                       0x10, 0x00, 0x00, 0x00, 0x01, 0xf6, 0xde, 0xcc, 0x83, 0x00, 0x00, 0x00,
                       0x0e, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x68, 0x60, 0x60, 0xf8,
                       0xff, 0x1f, 0x00, 0x05, 0x83, 0x02, 0x7f, 0x97, 0xe7, 0x38, 0xe6, 0x00,
                       0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  const Image image = decode_png(bytes).image;
  EXPECT_EQ(image.pixels, (std::vector<Rgb>{{128, 128, 128}, {255, 255, 255}}));
}

TEST(Png, RefusesEveryFileThatEndsTooSoon) {
  for (const Image& image : {colorful(19, 17), few_colors(11, 10)}) {
    const Bytes bytes = encode_png(image, {{"Title", "a"}, {"Name", "ö"}});
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_THROW(decode_png(std::span(bytes).first(length)), std::runtime_error) << length;
    }
  }
}

TEST(Png, SurvivesEveryFlippedBit) {
  const Bytes bytes = encode_png(few_colors(11, 10), {{"Title", "a"}, {"Name", "ö"}});
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    Bytes flipped = bytes;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
    try {
      decode_png(flipped);
    } catch (const std::runtime_error&) {
      continue;
    }
  }
}

TEST(Png, SurvivesRandomBytesBehindAGoodSignature) {
  std::mt19937 random(3);
  const Bytes good = encode_png(few_colors(11, 10), {{"Title", "a"}});
  for (int trial = 0; trial < 2000; ++trial) {
    Bytes bytes = good;
    const std::size_t changes = 1 + random() % 20;
    for (std::size_t i = 0; i < changes; ++i) {
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::uint8_t>(random());
    }
    try {
      decode_png(bytes);
    } catch (const std::runtime_error&) {
      continue;
    }
  }
}

TEST(Png, RefusesMorePixelsThanAllowed) {
  const Bytes bytes = encode_png(colorful(30, 20), {});
  EXPECT_NO_THROW(decode_png(bytes, 600));
  EXPECT_THAT([&] { decode_png(bytes, 599); },
              ThrowsMessage<std::runtime_error>(HasSubstr("30 x 20")));
}

TEST(Png, SaysWhatIsNoPng) {
  const Bytes bytes(100, 'x');
  EXPECT_THAT([&] { decode_png(bytes); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no PNG file")));
}

}  // namespace
}  // namespace clca::image::png_test
