#include "clca/render/movie.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "clca/process/program.hpp"
#include "clca/text/read.hpp"
#include "support/missing.hpp"
#include "support/runs.hpp"

namespace clca::render::movie_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kFrames = 12;

/// A bar that moves over coloured ground.
Image picture(int width, int height, int number) {
  Image image(width, height, {240, 228, 66});
  for (int y = 0; y < height; ++y) {
    for (int x = 5 * number; x < 5 * number + 20; ++x) {
      image.at(x, y) = {0, 114, 178};
    }
  }
  return image;
}

void write_movie(const fs::path& file, int width, int height) {
  Movie movie(file, file, width, height, 10);
  for (int i = 0; i < kFrames; ++i) {
    movie.add(picture(width, height, i));
  }
  movie.finish();
}

std::string output_of(std::vector<std::string> arguments) {
  arguments[0] = process::find_program(arguments[0]).value().string();
  const process::OutputCapture out;
  EXPECT_EQ(process::Program(arguments, {.output = &out}).wait(), 0);
  const auto bytes = out.bytes();
  return {bytes.begin(), bytes.end()};
}

/// Width, height, pictures per second and their number, as ffprobe tells them.
std::string probed(const fs::path& file) {
  return output_of({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                    "stream=width,height,avg_frame_rate,nb_read_frames", "-of", "csv=p=0",
                    file.string()});
}

/// A picture of the movie as its viewer sees it.
Image frame_of(const fs::path& file, int number, int width, int height) {
  const std::string raw = output_of({"ffmpeg", "-v", "error", "-i", file.string(), "-vf",
                                     "select=eq(n\\," + std::to_string(number) + ")", "-frames:v",
                                     "1", "-f", "rawvideo", "-pix_fmt", "rgb24", "pipe:1"});
  Image image(width, height, {});
  EXPECT_EQ(raw.size(), 3 * image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size() && 3 * i + 2 < raw.size(); ++i) {
    const auto channel = [&](std::size_t c) { return static_cast<std::uint8_t>(raw[3 * i + c]); };
    image.pixels[i] = {channel(0), channel(1), channel(2)};
  }
  return image;
}

int distance(Rgb a, Rgb b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

class MovieTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!process::find_program("ffmpeg") || !process::find_program("ffprobe")) {
      CLCA_SKIP_AS_MISSING("there is no ffmpeg");
    }
  }
  fs::path file(const std::string& name) const { return folder_.path() / name; }

  testing::ScratchFolder folder_;
};

TEST_F(MovieTest, HasAllPicturesInTheirOrderAndColours) {
  for (const char* name : {"a.mp4", "a.webm", "a.png"}) {
    write_movie(file(name), 96, 64);
    EXPECT_THAT(probed(file(name)), HasSubstr("96,64,10/1,12")) << name;
    const Image seen = frame_of(file(name), 9, 96, 64);
    EXPECT_LE(distance(seen.at(45 + 10, 32), {0, 114, 178}), 12) << name;
    EXPECT_LE(distance(seen.at(45 - 10, 32), {240, 228, 66}), 12) << name;
    EXPECT_LE(distance(seen.at(45 + 30, 32), {240, 228, 66}), 12) << name;
  }
}

TEST_F(MovieTest, AnAnimatedPngLosesNothing) {
  write_movie(file("a.png"), 97, 63);
  for (const int number : {0, 5, 11}) {
    EXPECT_EQ(frame_of(file("a.png"), number, 97, 63), picture(97, 63, number));
  }
}

TEST_F(MovieTest, OddSidesGetARowOrColumnMoreWhereTheFormatWantsIt) {
  write_movie(file("a.mp4"), 97, 63);
  write_movie(file("a.webm"), 97, 63);
  EXPECT_THAT(probed(file("a.mp4")), HasSubstr("98,64,"));
  EXPECT_THAT(probed(file("a.webm")), HasSubstr("98,64,"));
}

TEST_F(MovieTest, TheSamePicturesGiveTheSameBytes) {
  for (const char* ending : {".mp4", ".webm", ".png"}) {
    write_movie(file(std::string("a") + ending), 96, 64);
    write_movie(file(std::string("b") + ending), 96, 64);
    EXPECT_EQ(testing::bytes_of(file(std::string("a") + ending)),
              testing::bytes_of(file(std::string("b") + ending)))
        << ending;
  }
}

TEST_F(MovieTest, WhatFfmpegCannotWriteIsAnErrorWithItsReason) {
  const Image large(640, 480, {});
  try {
    Movie movie(file("missing/a.mp4"), file("missing/a.mp4"), 640, 480, 25);
    for (int i = 0; i < 100; ++i) {
      movie.add(large);
    }
    movie.finish();
    FAIL() << "no error";
  } catch (const MovieError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ffmpeg fails with exit code 1: "));
    EXPECT_THAT(error.what(), HasSubstr("No such file or directory"));
  }
}

TEST_F(MovieTest, AGifThatItsHundredthsOfASecondCannotTellIsRefused) {
  for (const double rate : {51.0, 240.0, 1 / 656.0}) {
    EXPECT_THAT(
        [&] { Movie(file("a.gif"), file("a.gif"), 16, 16, rate); },
        ::testing::ThrowsMessage<text::InputError>(HasSubstr("a GIF has at most 50 pictures")))
        << rate;
  }
  Movie movie(file("a.gif"), file("a.gif"), 96, 64, 50);
  for (int i = 0; i < kFrames; ++i) {
    movie.add(picture(96, 64, i));
  }
  movie.finish();
  EXPECT_THAT(probed(file("a.gif")), HasSubstr("50/1,12"));
}

TEST_F(MovieTest, WithoutPicturesOrWithOnesOfAnotherSizeThereIsNone) {
  Movie empty(file("a.mp4"), file("a.mp4"), 64, 64, 25);
  EXPECT_THROW(empty.finish(), MovieError);
  Movie movie(file("b.mp4"), file("b.mp4"), 64, 64, 25);
  EXPECT_THROW(movie.add(Image(64, 66, {})), std::invalid_argument);
}

TEST(MovieFormatTest, FollowsTheEnding) {
  EXPECT_EQ(movie_format("x/a.mp4"), MovieFormat::mp4);
  EXPECT_EQ(movie_format("a.b.webm"), MovieFormat::webm);
  EXPECT_EQ(movie_format("a.png"), MovieFormat::apng);
  EXPECT_EQ(movie_format("a.webp"), MovieFormat::webp);
  EXPECT_EQ(movie_format("a.gif"), MovieFormat::gif);
  for (const char* name : {"a.avi", "mp4", ".mp4", "a.mp4/", ""}) {
    EXPECT_THROW(movie_format(name), text::InputError) << name;
  }
}

}  // namespace
}  // namespace clca::render::movie_test
