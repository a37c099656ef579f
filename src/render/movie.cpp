#include "clca/render/movie.hpp"

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "clca/text/read.hpp"

namespace clca::render {

namespace {

using Arguments = std::vector<std::string>;

// A GIF counts hundredths of a second, in 16 bits. Programs show one that is to last a single
// hundredth for ten.
constexpr double kMostGifRate = 50;
constexpr double kLongestGifPicture = 655;  // s

std::filesystem::path find_ffmpeg() {
  if (const auto file = process::find_program("ffmpeg")) {
    return *file;
  }
  throw MovieError("ffmpeg not found; install ffmpeg (Debian) or put ffmpeg on the PATH");
}

void append(Arguments& arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
}

/// Colour format that players expect: even sides, half chroma resolution, marked as such.
Arguments video_arguments() {
  constexpr const char* kFilter =
      "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,"
      "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_inp+bitexact,"
      "format=yuv420p";
  return {"-vf",   kFilter,      "-colorspace",  "bt709",        "-color_primaries",
          "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"};
}

Arguments format_arguments(MovieFormat format) {
  Arguments arguments = video_arguments();
  switch (format) {
    case MovieFormat::mp4:  // veryfast: half the time, files 4 % larger
      append(arguments, {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-movflags",
                         "+faststart", "-f", "mp4"});
      return arguments;
    case MovieFormat::webm:
      append(arguments, {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good",
                         "-cpu-used", "4", "-f", "webm"});
      return arguments;
    case MovieFormat::apng:
      return {"-c:v", "apng", "-pred", "mixed", "-plays", "0", "-f", "apng"};
    case MovieFormat::webp:
      return {"-c:v", "libwebp_anim", "-quality", "85", "-loop", "0", "-f", "webp"};
    case MovieFormat::gif:
      break;
  }
  // A palette for each picture: one for all would hold all pictures in memory.
  return {"-vf",   "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1",
          "-loop", "0",
          "-f",    "gif"};
}

Arguments ffmpeg_arguments(const std::filesystem::path& file, MovieFormat format, int width,
                           int height, double frames_per_second) {
  if (format == MovieFormat::gif &&
      (frames_per_second > kMostGifRate || 1 / frames_per_second > kLongestGifPicture)) {
    throw text::InputError(fmt::format(
        "a GIF has at most {:g} pictures a second, and shows each for at most {:g} s; choose "
        "another number of pictures, length or format",
        kMostGifRate, kLongestGifPicture));
  }
  // xerror: a disk that is full at the end is an error, too.
  Arguments arguments = {find_ffmpeg().string()};
  append(arguments,
         {"-nostdin", "-xerror", "-hide_banner", "-loglevel", "error", "-f", "rawvideo"});
  append(arguments, {"-pix_fmt", "rgb24", "-video_size", fmt::format("{}x{}", width, height)});
  append(arguments, {"-framerate", fmt::format("{}", frames_per_second), "-i", "pipe:0", "-y"});
  append(arguments, format_arguments(format));
  // Reproducible bytes: independent of time and number of processors.
  append(arguments, {"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact",
                     "-map_metadata", "-1", "file:" + std::filesystem::absolute(file).string()});
  return arguments;
}

process::Program start_ffmpeg(const Arguments& arguments, const process::OutputCapture& errors,
                              const std::atomic<int>* stop) {
  try {
    return {arguments,
            {.output = &errors,
             .error_output = &errors,
             .is_fed = true,
             .stop = stop,
             .grace_period = std::chrono::seconds(5)}};
  } catch (const process::ProcessError& error) {
    throw MovieError(error.what());
  }
}

std::string last_line(const std::vector<std::uint8_t>& bytes) {
  std::stringstream text(std::string(bytes.begin(), bytes.end()));
  std::string last = "no reason given";
  for (std::string line; std::getline(text, line);) {
    if (!line.empty()) {
      last = line;
    }
  }
  return last;
}

}  // namespace

MovieFormat movie_format(const std::filesystem::path& file) {
  const std::map<std::string, MovieFormat> formats = {{".mp4", MovieFormat::mp4},
                                                      {".webm", MovieFormat::webm},
                                                      {".webp", MovieFormat::webp},
                                                      {".gif", MovieFormat::gif},
                                                      {".png", MovieFormat::apng}};
  const auto found = formats.find(file.extension().string());
  if (found == formats.end()) {
    throw text::InputError(fmt::format(
        "{}: is not a movie; expected the ending .mp4, .webm, .webp, .gif or .png (animated)",
        file.string()));
  }
  return found->second;
}

Movie::Movie(const std::filesystem::path& file, const std::filesystem::path& temporary, int width,
             int height, double frames_per_second, const std::atomic<int>* stop)
    : file_(file),
      width_(width),
      height_(height),
      ffmpeg_(start_ffmpeg(
          ffmpeg_arguments(temporary, movie_format(file), width, height, frames_per_second),
          errors_, stop)) {}

void Movie::add(const Image& image) {
  if (image.width != width_ || image.height != height_) {
    throw std::invalid_argument("the pictures of a movie have one size");
  }
  static_assert(sizeof(Rgb) == 3, "goes to ffmpeg as it lies in memory");
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(image.pixels.data());
  if (!ffmpeg_.feed({bytes, sizeof(Rgb) * image.pixels.size()})) {
    fail(ffmpeg_.wait());
  }
  has_pictures_ = true;
}

void Movie::finish() {
  const int code = ffmpeg_.wait();
  if (code != 0 || !has_pictures_) {
    fail(code);
  }
}

void Movie::fail(int code) const {
  throw MovieError(fmt::format("cannot write {}: ffmpeg fails with exit code {}: {}",
                               file_.string(), code, last_line(errors_.bytes())));
}

}  // namespace clca::render
