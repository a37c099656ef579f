#include "plot/gnuplot.hpp"

#include <fmt/format.h>

#include <sstream>

#include "clca/plot/plot.hpp"
#include "clca/process/program.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

/// gnuplot shows the command, a mark below it, and then `"FILE" line N: what is wrong`.
std::string first_complaint(const std::vector<std::uint8_t>& bytes) {
  std::stringstream text(std::string(bytes.begin(), bytes.end()));
  std::string first;
  for (std::string line; std::getline(text, line);) {
    if (line.find("line ") != std::string::npos && line.find(": ") != std::string::npos &&
        line.find("warning:") == std::string::npos) {
      return line;
    }
    if (first.empty()) {
      first = line;
    }
  }
  return first;
}

}  // namespace

std::string array_text(const std::string& name, const std::vector<std::string>& values) {
  std::string list;
  for (const std::string& value : values) {
    list += (list.empty() ? "" : ", ") + literal(value);
  }
  return fmt::format("array {}[{}] = [{}];", name, values.size(), list);
}

fs::path find_gnuplot() {
  if (const auto file = process::find_program("gnuplot")) {
    return *file;
  }
  throw PlotError("gnuplot not found; install gnuplot-nox (Debian) or put gnuplot on the PATH");
}

// In single quotes gnuplot takes no apostrophe at the beginning, and in double ones it runs what is
// in backquotes. A digit after an octal number would belong to it.
std::string literal(std::string_view text) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  constexpr std::string_view kPlain = " _-.,:/+=()|";
  constexpr std::string_view kDigits = "0123456789";
  std::string result = "\"";
  bool is_plain = true;
  for (const char byte : text) {
    const char letter = static_cast<unsigned char>(byte) < ' ' ? ' ' : byte;
    is_plain = kLetters.find(letter) != std::string_view::npos ||
               kPlain.find(letter) != std::string_view::npos ||
               (is_plain && kDigits.find(letter) != std::string_view::npos);
    result += is_plain ? std::string(1, letter)
                       : fmt::format("\\{:03o}", static_cast<unsigned char>(letter));
  }
  return result + '"';
}

std::vector<std::uint8_t> gnuplot(const fs::path& program, const fs::path& folder,
                                  const std::string& commands, const std::vector<fs::path>& scripts,
                                  const std::atomic<int>* stop) {
  // -d: ignores user settings, so that the same tables give the same picture.
  std::vector<std::string> arguments = {program.string(), "-d", "-e", commands};
  for (const fs::path& script : scripts) {
    arguments.push_back(fs::absolute(script).string());
  }
  try {
    const process::OutputCapture out;
    const process::OutputCapture err;
    const int code =
        process::Program(arguments, {.folder = folder, .out = &out, .err = &err, .stop = stop})
            .wait();
    if (code != 0) {
      throw PlotError(
          fmt::format("gnuplot fails with exit code {}: {}", code, first_complaint(err.bytes())));
    }
    return out.bytes();
  } catch (const process::StoppedError&) {
    throw;
  } catch (const process::ProcessError& error) {
    throw PlotError(error.what());
  }
}

}  // namespace clca::plot
