#include "report/page.hpp"

#include <fmt/format.h>

#include "embedded.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

std::string head_html(const std::string& title) {
  // Forbids all loading, whatever the files of the run contain.
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="clca">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; media-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'">
<title>{}</title>
<style>
{}</style>
</head>
)",
                     escaped(title), kStyle);
}

std::string header_html(const Page& page) {
  std::string facts;
  for (const auto& [name, value] : page.facts) {
    facts += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, value);
  }
  return fmt::format(
      R"(<header>
<p class="kind">{} <b class="status{}">{}</b></p>
<h1>{}</h1>
<p class="scene-name">Scene <code>{}</code></p>
<dl class="facts">
{}</dl>
</header>
)",
      page.kind, page.status == "done" ? "" : " incomplete", escaped(page.status),
      escaped(page.title), escaped(page.scene), facts);
}

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

std::string navigation_html(const std::vector<Section>& sections) {
  std::string links;
  for (const Section& section : sections) {
    links += fmt::format("<a href=\"#{}\">{}</a>\n", section.id, section.name);
  }
  return fmt::format("<nav aria-label=\"Sections\">\n{}</nav>\n", links);
}

}  // namespace

std::string to_html(const Page& page, const Warnings& warnings) {
  std::vector<Section> sections = page.sections;
  std::erase_if(sections, [](const Section& section) { return section.content.empty(); });
  std::string html = head_html(page.title);
  html += "<body>\n" + header_html(page) + navigation_html(sections) + "<main>\n";
  html += warnings_html(warnings);
  for (const Section& section : sections) {
    html += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", section.id, section.name);
    html += section.content;
    html += "</section>\n";
  }
  html += "</main>\n<script>\n";
  html += kScript;
  html += "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace clca::report
