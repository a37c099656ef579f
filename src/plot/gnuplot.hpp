#pragma once
// The program gnuplot, called without a shell.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace clca::plot {

/// `text` as a string of gnuplot that means nothing but itself. Control characters become spaces.
std::string literal(std::string_view text);

/// Runs gnuplot in `folder` on `commands`, then on each script; what it leaves on its standard
/// output. Throws PlotError with its first complaint, and where it is not on the PATH;
/// process::Stopped once `stop` is not zero.
std::vector<std::uint8_t> gnuplot(const std::filesystem::path& folder, const std::string& commands,
                                  const std::vector<std::filesystem::path>& scripts,
                                  const std::atomic<int>* stop);

}  // namespace clca::plot
