#pragma once
// Moving pictures, encoded by the program ffmpeg.

#include <atomic>
#include <filesystem>
#include <stdexcept>

#include "clca/process/program.hpp"
#include "clca/render/image.hpp"

namespace clca::render {

/// ffmpeg is missing or fails. what() is one line.
class MovieError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `mp4`: H.264 for any player; `webm`: VP9. In a loop: `apng`, an animated PNG, without loss;
/// `webp`; `gif`, of 256 colours a picture.
enum class MovieFormat : std::uint8_t { mp4, webm, apng, webp, gif };

/// The format for a file ending: .mp4, .webm, .png, .webp or .gif. Throws text::InputError for
/// others.
MovieFormat movie_format(const std::filesystem::path& file);

/// Encodes pictures one by one, so that memory does not grow with their number. The same pictures
/// and the same ffmpeg give the same bytes.
class Movie {
 public:
  /// Writes the movie `file` in its format to `temporary`, overwriting that. All pictures have this
  /// size (pixels); mp4 and webm pad odd sizes with white. Throws MovieError, and text::InputError
  /// for a rate that the format does not have. Once `stop` is not zero, ffmpeg gets 5 s to finish
  /// what it has.
  Movie(const std::filesystem::path& file, const std::filesystem::path& temporary, int width,
        int height, double frames_per_second, const std::atomic<int>* stop = nullptr);
  /// The file of a movie that is not finished remains incomplete.
  ~Movie() = default;
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Throws MovieError, process::StoppedError, and std::invalid_argument for a picture of
  /// another size.
  void add(const Image& image);
  /// Completes the file. Throws MovieError, also if there was no picture, and
  /// process::StoppedError.
  void finish();

 private:
  [[noreturn]] void fail(int code) const;

  std::filesystem::path file_;
  int width_;
  int height_;
  bool has_pictures_ = false;
  process::OutputCapture errors_;
  process::Program ffmpeg_;
};

}  // namespace clca::render
