#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>

#include "clca/plot/plot.hpp"
#include "clca/process/data_folder.hpp"
#include "plot/gnuplot.hpp"
#include "plot/template.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

bool is_whole(const std::vector<std::uint8_t>& bytes, Format format) {
  constexpr std::array<std::string_view, 3> kEnds = {"IEND\xae\x42\x60\x82", "</svg>", "%%EOF"};
  const std::string_view end = kEnds[static_cast<std::size_t>(format)];
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.substr(0, text.find_last_not_of('\n') + 1).ends_with(end);
}

/// For ids in an SVG.
std::string identifier(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; },
      '_');
  return name;
}

}  // namespace

fs::path template_folder() {
  std::error_code error;
  fs::path folder = process::data_folder("plots");
  if (!fs::exists(folder / kStyleFile, error)) {
    throw PlotError(fmt::format("no templates of figures in {}", folder.string()));
  }
  return folder;
}

const char* ending(Format format) {
  constexpr std::array kEndings = {"png", "svg", "pdf"};
  return kEndings[static_cast<std::size_t>(format)];
}

std::vector<std::uint8_t> draw(const Figure& figure, const Appearance& appearance,
                               const std::atomic<int>* stop) {
  const std::string commands =
      fmt::format("{} title = {}; name = {}; format = '{}'; width = {}; height = {}",
                  figure.setting, literal(figure.title), literal(identifier(figure.name)),
                  ending(appearance.format), appearance.width, appearance.height);
  const fs::path program = find_gnuplot();
  try {
    std::vector<std::uint8_t> bytes =
        gnuplot(program, figure.run, commands,
                {figure.script.parent_path() / kStyleFile, figure.script}, stop);
    if (!is_whole(bytes, appearance.format)) {
      throw PlotError("gnuplot leaves no whole picture");
    }
    return bytes;
  } catch (const PlotError& error) {
    throw PlotError(fmt::format("{}: {}", figure.name, error.what()));
  }
}

}  // namespace clca::plot
