#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "clca/text/message.hpp"
#include "embedded.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMaxSceneText = 256 << 10;

struct Section {
  const char* id = "";
  const char* name = "";
  std::string content = {};
};

std::string head_html(const std::string& title) {
  // Forbids all loading, whatever the files of the run contain.
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="clca">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'">
<title>{}</title>
<style>
{}</style>
</head>
)",
                     escaped(title), kStyle);
}

std::string fact(const char* name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, value);
}

bool is_gas(const store::RunSummary& summary) {
  return summary.kind == "boltzmann";
}

const char* kind_text(const store::RunSummary& summary) {
  if (is_gas(summary)) {
    return "Gas of rough spheres, Boltzmann equation";
  }
  return summary.kind == "contact" ? "Lattice contact dynamics" : "Granular cellular automaton";
}

std::string facts_html(const store::RunSummary& summary) {
  std::string facts = fact("Seed", fmt::format("{}", summary.seed));
  facts += fact("Particles", whole(summary.particles));
  facts += fact("Steps", whole(summary.steps));
  if (summary.units) {
    facts += fact("Time", escaped(summary.units->time_text(summary.steps)));
  }
  facts += fact("Time taken", brief(summary.wall_seconds) + " s");
  facts += fact(is_gas(summary) ? "Collisions per second" : "Particle updates per second",
                brief(summary.rate));
  facts += fact("Threads", whole(static_cast<std::uint64_t>(std::max(summary.threads, 0))));
  facts += fact("State hash", fmt::format("<code>{:016x}</code>", summary.state_hash));
  facts += fact("Made by", fmt::format("clca {} <small>{}, {}</small>", escaped(summary.version),
                                       escaped(summary.compiler), escaped(summary.build_type)));
  return fmt::format("<dl class=\"facts\">\n{}</dl>\n", facts);
}

std::string header_html(const Page& page, const store::RunSummary& summary) {
  const bool is_done = summary.status == "done";
  return fmt::format(
      R"(<header>
<p class="kind">{} <b class="status{}">{}</b></p>
<h1>{}</h1>
<p class="scene-name">Scene <code>{}</code></p>
{}</header>
)",
      kind_text(summary), is_done ? "" : " incomplete", escaped(summary.status),
      escaped(page.title), escaped(summary.scene), facts_html(summary));
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

/// The scene as a download, needed for the command.
std::string scene_html(const Page& page, const store::RunSummary& summary) {
  if (page.scene_text.empty()) {
    return {};
  }
  if (page.scene_text.size() > kMaxSceneText) {
    return "<p>The scene is too long to be shown here; it is in <code>scene.yaml</code> beside "
           "this page.</p>\n";
  }
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(page.scene_text.data()),
                        page.scene_text.size());
  return fmt::format(
      R"(<details><summary>The scene, with every default filled in</summary>
<p><a download="{}.yaml" href="data:text/yaml;base64,{}">Save it as a file</a></p>
<pre class="scene">{}</pre></details>
)",
      escaped(summary.scene), base64(bytes), escaped(page.scene_text));
}

std::string repeat_html(const Page& page, const store::RunSummary& summary) {
  const std::string result =
      summary.status == "done"
          ? fmt::format("comes to the state hash <code>{:016x}</code> with any number of threads",
                        summary.state_hash)
          : "goes the same way, with any number of threads, and on from where this run has ended";
  return fmt::format(
      R"(<p>The same scene and seed give the same bits: clca {} on the scene below {}.</p>
<pre>clca run {} --seed {} -o {}</pre>
{})",
      escaped(summary.version), result, escaped(text::shell_word(summary.scene + ".yaml")),
      summary.seed, escaped(text::shell_word(summary.scene)), scene_html(page, summary));
}

std::string files_html(const Page& page) {
  constexpr std::size_t kMaxItems = 100;
  std::string items;
  for (std::size_t i = 0; i < std::min(page.files.size(), kMaxItems); ++i) {
    items += fmt::format("<li><code>{}</code></li>", escaped(page.files[i]));
  }
  return items.empty()
             ? items
             : fmt::format(
                   R"(<p>The tables that this page is drawn from lie in the run folder:</p>
<ul class="files">{}{}</ul>
)",
                   items, page.files.size() > kMaxItems ? "<li>…</li>" : "");
}

std::string navigation_html(const std::vector<Section>& sections) {
  std::string links;
  for (const Section& section : sections) {
    links += fmt::format("<a href=\"#{}\">{}</a>\n", section.id, section.name);
  }
  return fmt::format("<nav aria-label=\"Sections\">\n{}</nav>\n", links);
}

}  // namespace

std::string to_html(const Page& page, const store::RunSummary& summary, const Warnings& warnings) {
  std::vector<Section> sections = {{"pictures", "Pictures", page.frames},
                                   {"measures", "Measures", page.measures},
                                   {"figures", "Figures", page.figures},
                                   {"walls", "Walls", page.walls},
                                   {"repeat", "How to repeat it", repeat_html(page, summary)},
                                   {"files", "Tables", files_html(page)}};
  std::erase_if(sections, [](const Section& section) { return section.content.empty(); });
  std::string html = head_html(page.title);
  html += "<body>\n" + header_html(page, summary) + navigation_html(sections) + "<main>\n";
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
