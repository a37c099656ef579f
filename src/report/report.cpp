#include "clca/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/summary.hpp"
#include "report/charts.hpp"
#include "report/maps.hpp"
#include "report/page.hpp"
#include "report/sections.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;

store::RunSummary summary_of(const fs::path& run) {
  try {
    const fs::path file = run / "run.json";
    store::RunSummary summary = store::read_summary(file);
    const auto kinds = {"automaton", "contact", "boltzmann"};
    if (std::find(kinds.begin(), kinds.end(), summary.kind) == kinds.end()) {
      throw store::StoreError(fmt::format("cannot read {}: no report of a run of kind '{}'",
                                          file.string(), summary.kind));
    }
    return summary;
  } catch (const store::StoreError& error) {
    throw InputError(error.what());
  }
}

/// Reads scene.yaml into a page; without it, the title is the name of the scene.
void read_scene(Page& page, const fs::path& run, const store::RunSummary& summary,
                Warnings& warnings) {
  page.title = summary.scene;
  try {
    const fs::path file = run / "scene.yaml";
    const auto text = store::read_whole(file, scene::kMostSceneBytes);
    page.scene_text = {text.begin(), text.end()};
    const scene::AnyScene scene = scene::parse_any(page.scene_text, file.string());
    const std::string title = std::visit([](const auto& one) { return one.title; }, scene);
    // The name of the file where the scene has no title.
    page.title = title == file.stem() ? page.title : title;
  } catch (const scene::SceneError& error) {
    warnings.add(error.what());
  } catch (const store::StoreError& error) {
    warnings.add(error.what());
  }
}

std::string charts_html(const Tables& tables) {
  constexpr std::size_t kMostCharts = 100;
  const std::vector<Chart> charts =
      tables.summary().kind == "boltzmann" ? charts_of_gas(tables) : charts_of_automaton(tables);
  std::string html;
  for (std::size_t i = 0; i < std::min(charts.size(), kMostCharts); ++i) {
    html += to_html(charts[i], i + 1);
  }
  return html.empty() ? html : "<div class=\"charts\">\n" + html + "</div>\n";
}

std::string maps_html(const Tables& tables) {
  std::vector<std::string> figures;
  add_force_maps(figures, tables);
  add_convection_maps(figures, tables);
  add_field_maps(figures, tables);
  std::string html;
  for (const std::string& figure : figures) {
    html += figure;
  }
  return html.empty() ? html : "<div class=\"charts\">\n" + html + "</div>\n";
}

}  // namespace

fs::path write_report(const fs::path& run, const Options& options) {
  const store::RunSummary summary = summary_of(run);
  Warnings warnings(options.warning);
  const Tables tables(run, summary, warnings);
  Page page;
  read_scene(page, run, summary, warnings);
  page.frames = frames_html(run, summary, options.most_frames, warnings);
  page.measures = measures_html(summary);
  page.walls = walls_html(tables);
  page.charts = charts_html(tables);
  page.maps = maps_html(tables);
  page.files = tables.files();
  const store::OutputFile file = options.file.empty()
                                     ? store::OutputFile{store::OutputFolder(run), "report.html"}
                                     : store::named_file(options.file);
  file.folder.write(file.name, to_html(page, summary, warnings), file.replace);
  return file.path();
}

}  // namespace clca::report
