#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "clca/plot/plot.hpp"
#include "plot/gnuplot.hpp"
#include "plot/template.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

/// By its first and last bytes.
bool is_whole_png(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 8> kBegin = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::array<std::uint8_t, 8> kEnd = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
  return bytes.size() >= kBegin.size() + kEnd.size() &&
         std::equal(kBegin.begin(), kBegin.end(), bytes.begin()) &&
         std::equal(kEnd.rbegin(), kEnd.rend(), bytes.rbegin());
}

}  // namespace

fs::path template_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const std::array candidates = {
      (program.parent_path() / CLCA_PLOTS_FROM_PROGRAM).lexically_normal(),
      fs::path(CLCA_PLOTS_IN_SOURCE)};
  for (const fs::path& folder : candidates) {
    if (fs::exists(folder / kStyleFile, error)) {
      return folder;
    }
  }
  throw PlotError(fmt::format("no templates of figures, neither in {} nor in {}",
                              candidates[0].string(), candidates[1].string()));
}

std::vector<std::uint8_t> draw(const Figure& figure, const Size& size,
                               const std::atomic<int>* stop) {
  const std::string commands =
      fmt::format("{} width = {}; height = {}", figure.setting, size.width, size.height);
  try {
    std::vector<std::uint8_t> bytes = gnuplot(
        figure.run, commands, {figure.script.parent_path() / kStyleFile, figure.script}, stop);
    if (!is_whole_png(bytes)) {
      throw PlotError("gnuplot leaves no whole picture");
    }
    return bytes;
  } catch (const PlotError& error) {
    throw PlotError(fmt::format("{}: {}", figure.name, error.what()));
  }
}

}  // namespace clca::plot
