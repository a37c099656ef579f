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
constexpr double kWidth = 560;

std::string picture_html(const plot::Picture& picture) {
  const std::string text(picture.bytes.begin(), picture.bytes.end());
  if (picture.format == "svg") {
    return text.substr(std::min(text.find("<svg"), text.size()));
  }
  return fmt::format(R"(<img src="data:image/png;base64,{}" width="{}" alt="{}">)",
                     base64(picture.bytes), 2 * kWidth, escaped(picture.about));
}

}  // namespace

std::string figures_html(const fs::path& run, Warnings& warnings) {
  constexpr std::size_t kMaxFigures = 60;
  std::string html;
  try {
    const auto [pictures, unreadable] =
        plot::pictures_of_page(run, {.format = "svg", .width = kWidth}, kMaxFigures);
    for (const std::string& warning : unreadable) {
      warnings.add(warning);
    }
    for (const plot::Picture& picture : pictures) {
      html += fmt::format(
          "<figure class=\"chart\" id=\"figure-{}\">\n{}<figcaption>{}</figcaption>\n</figure>\n",
          escaped(picture.name), picture_html(picture), escaped(picture.about));
    }
  } catch (const std::runtime_error& error) {  // PlotError, text::InputError
    warnings.add(error.what());
  }
  return html.empty() ? html : "<div class=\"charts\">\n" + html + "</div>\n";
}

}  // namespace clca::report
