#pragma once
// Moving pictures, encoded by the program ffmpeg.

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "clca/render/image.hpp"

namespace clca::render {

/// ffmpeg is missing or fails. what() is one line.
class MovieError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `mp4`: H.264 for any player; `webm`: VP9; `apng`: an animated PNG, without loss, for ever again.
enum class MovieFormat : std::uint8_t { mp4, webm, apng };

/// By the ending of a file: .mp4, .webm or .png; nothing for all others.
std::optional<MovieFormat> movie_format(const std::filesystem::path& file);

/// Takes one picture after the other and hands it on, so that memory does not grow with their
/// number. The same pictures give the same bytes, with the same ffmpeg.
class Movie {
 public:
  /// Writes to `file`, whatever was there, for pictures of one size (pixels). mp4 and webm get a
  /// white row or column where a size is odd. Once `stop` is not zero, ffmpeg has 5 s left for what
  /// it has been given. Throws MovieError.
  Movie(const std::filesystem::path& file, MovieFormat format, int width, int height,
        int frames_per_second, const std::atomic<int>* stop = nullptr);
  /// What was not finished is left half written.
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Throws MovieError, process::Stopped, and std::invalid_argument for a picture of another size.
  void add(const Image& image);
  /// The file is whole when this returns. Throws MovieError, also when there was no picture, and
  /// process::Stopped.
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::render
