#pragma once
// Running gnuplot.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace clca::plot {

/// `text` as a literal gnuplot string. Control characters become spaces.
std::string literal(std::string_view text);

/// `array NAME[2] = ['a', 'b'];` of at least one value.
std::string array_text(const std::string& name, const std::vector<std::string>& values);

/// Throws PlotError if it is not on the PATH.
std::filesystem::path find_gnuplot();

/// Runs the program in `folder` on `commands`, then on each script; returns its standard output.
/// Throws PlotError with its first error; process::StoppedError once `stop` is not zero.
std::vector<std::uint8_t> gnuplot(const std::filesystem::path& program,
                                  const std::filesystem::path& folder, const std::string& commands,
                                  const std::vector<std::filesystem::path>& scripts,
                                  const std::atomic<int>* stop);

}  // namespace clca::plot
