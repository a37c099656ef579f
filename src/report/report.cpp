#include "clca/report/report.hpp"

#include <fmt/format.h>

#include <system_error>

#include "clca/store/output_folder.hpp"
#include "embedded.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

std::string warnings_html(const Warnings& warnings) {
  std::string items;
  for (const std::string& text : warnings.texts()) {
    items += fmt::format("<li>{}</li>\n", escaped(text));
  }
  return items.empty() ? items
                       : fmt::format(
                             "<aside class=\"warnings\" aria-label=\"Left out\"><p>Not all of the "
                             "run could be "
                             "shown:</p><ul>\n{}</ul></aside>\n",
                             items);
}

}  // namespace

std::string to_html(const Page& page, const Warnings& warnings) {
  std::string facts;
  for (const auto& [name, value] : page.facts) {
    facts += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, value);
  }
  std::string links;
  std::string sections;
  for (const Section& section : page.sections) {
    if (!section.content.empty()) {
      links += fmt::format("<a href=\"#{}\">{}</a>\n", section.id, section.name);
      sections += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", section.id,
                              section.name, section.content);
    }
  }
  // The page forbids all loading, whatever the files of the run contain.
  return fmt::format(fmt::runtime(kPage), fmt::arg("title", escaped(page.title)),
                     fmt::arg("style", kStyle), fmt::arg("kind", page.kind),
                     fmt::arg("status_class", page.status == "done" ? "done" : "incomplete"),
                     fmt::arg("status", escaped(page.status)),
                     fmt::arg("scene", escaped(page.scene)), fmt::arg("facts", facts),
                     fmt::arg("links", links), fmt::arg("warnings", warnings_html(warnings)),
                     fmt::arg("sections", sections), fmt::arg("script", kScript));
}

namespace fs = std::filesystem;

fs::path write_report(const fs::path& folder, const Options& options) {
  Warnings warnings(options.warning);
  std::error_code error;
  const bool is_sweep = fs::exists(folder / "sweep.json", error);
  const Page page =
      is_sweep ? sweep_page(folder, warnings) : run_page(folder, options.max_frames, warnings);
  const store::OutputFile file = options.file.empty()
                                     ? store::OutputFile{store::OutputFolder(folder), "report.html"}
                                     : store::named_file(options.file);
  file.folder.write(file.name, to_html(page, warnings), file.replace);
  return file.path();
}

}  // namespace clca::report
