#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "clca/plot/plot.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;

/// Wide enough for letters that can be read on a phone.
constexpr plot::Appearance kSvg = {.format = plot::Format::svg, .width = 560};
constexpr plot::Appearance kPng = {.format = plot::Format::png, .width = 1120};
constexpr std::size_t kMaxSvgBytes = 300'000;

/// gnuplot's script for the coordinates under the pointer, which all figures of a page share, as
/// the first one brings it. The next element of that name has the axes.
class SharedScript {
 public:
  /// The svg element of a whole file, with the script if it is the first one.
  std::string element(const std::string& file) {
    const std::size_t begin = std::min(file.find("<svg"), file.size());
    std::string svg = file.substr(begin);
    const std::size_t script = svg.find("<script");
    const std::size_t end = svg.find("</script>");
    if (is_there_ && end != std::string::npos && script < end) {
      const std::size_t body = svg.find('>', script) + 1;
      svg.erase(body, end - body);
    }
    is_there_ = is_there_ || end != std::string::npos;
    return svg;
  }

 private:
  bool is_there_ = false;
};

std::string picture_html(const plot::Figure& figure, SharedScript& script) {
  const std::vector<std::uint8_t> svg = plot::draw(figure, kSvg);
  if (svg.size() <= kMaxSvgBytes) {
    return script.element({svg.begin(), svg.end()});
  }
  return fmt::format(R"(<img src="data:image/png;base64,{}" width="{}" alt="{}">)",
                     base64(plot::draw(figure, kPng)), kPng.width, escaped(figure.description));
}

}  // namespace

std::string figures_html(const fs::path& run, Warnings& warnings) {
  constexpr std::size_t kMaxFigures = 60;
  std::string html;
  try {
    std::vector<plot::Figure> figures = plot::figures_of_readable_tables(
        run, plot::template_folder(), [&](const std::string& text) { warnings.add(text); });
    SharedScript script;
    figures.resize(std::min(figures.size(), kMaxFigures));
    for (plot::Figure& figure : figures) {
      figure.title.clear();  // that of the page
      try {
        html += fmt::format(
            "<figure class=\"chart\" id=\"figure-{}\">\n{}<figcaption>{}</figcaption>\n</figure>\n",
            escaped(figure.name), picture_html(figure, script), escaped(figure.description));
      } catch (const plot::PlotError& error) {
        warnings.add(error.what());
      }
    }
  } catch (const std::runtime_error& error) {  // PlotError, text::InputError
    warnings.add(error.what());
  }
  return html.empty() ? html : "<div class=\"charts\">\n" + html + "</div>\n";
}

}  // namespace clca::report
