#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
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

/// gnuplot writes "]]>" in a text as it is, which XML allows only where a section ends.
void escape_section_ends(std::vector<std::uint8_t>& svg) {
  constexpr std::string_view kBegin = "<![CDATA[";  // no text has it: "<" is escaped
  constexpr std::string_view kEnd = "]]>";
  std::string text(svg.begin(), svg.end());
  std::size_t section = text.find(kBegin);
  for (std::size_t at = text.find(kEnd); at != std::string::npos; at = text.find(kEnd, at + 1)) {
    if (section > at) {
      text.replace(at, kEnd.size(), "]]&gt;");
    }
    section = text.find(kBegin, at);
  }
  svg.assign(text.begin(), text.end());
}

/// For ids in an SVG.
std::string identifier(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return std::isalnum(letter) == 0; },
      '_');
  return name;
}

/// The canvas in pixels, which in a PDF are 1/96 inch.
struct Canvas {
  double width;
  double height;
  double letter;  ///< mean width of a letter
  int dots;       ///< in an inch; 0: letters scale with the picture
};

Canvas canvas_of(const Appearance& appearance) {
  const double aspect = appearance.in_mm ? 0.75 : 0.625;
  constexpr double kInch = 25.4;
  constexpr double kLetter = 0.56;  // of the height of the font
  const int dots = appearance.format == Format::png ? 300 : 96;
  const double pixel = appearance.in_mm ? dots / kInch : 1;
  const double width = std::round(appearance.width * pixel);
  const double height = std::round(appearance.height.value_or(aspect * appearance.width) * pixel);
  if (appearance.in_mm) {
    return {width, height, kLetter * 8 / 72 * dots, dots};
  }
  const double scale = appearance.format == Format::svg   ? 1
                       : appearance.format == Format::pdf ? (width + 1.6 * height) / 1920
                                                          : (width + 1.6 * height) / 1920 * 4 / 3;
  return {width, height, kLetter * 13 * scale, 0};
}

/// As lines that fit, joined in the language of gnuplot.
std::string lines_of(const std::string& title, std::size_t most) {
  std::string text;
  std::string line;
  std::istringstream words(title);
  const auto add = [&] { text += (text.empty() ? "" : R"( . "\n" . )") + literal(line); };
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > most) {
      add();
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  add();
  return text;
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
  const Canvas canvas = canvas_of(appearance);
  const auto line = static_cast<std::size_t>(0.9 * canvas.width / canvas.letter);
  const std::string commands = fmt::format(
      "{} title = {}; line_length = {}; name = {}; format = '{}'; width = {}; height = {}; "
      "height_is_free = {}; dots = {}",
      figure.setting, lines_of(figure.title, line), line, literal(identifier(figure.name)),
      ending(appearance.format), canvas.width, canvas.height, appearance.height ? 0 : 1,
      canvas.dots);
  const fs::path program = find_gnuplot();
  try {
    std::vector<std::uint8_t> bytes =
        gnuplot(program, figure.run, commands,
                {figure.script.parent_path() / kStyleFile, figure.script}, stop);
    if (appearance.format == Format::svg) {
      escape_section_ends(bytes);
    }
    if (!is_whole(bytes, appearance.format)) {
      throw PlotError("gnuplot leaves no whole picture");
    }
    return bytes;
  } catch (const PlotError& error) {
    throw PlotError(fmt::format("{}: {}", figure.name, error.what()));
  }
}

}  // namespace clca::plot
