#include "clca/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/text/input_error.hpp"
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
    throw text::InputError(error.what());
  }
}

/// The text of scene.yaml.
std::string scene_text(const fs::path& run, Warnings& warnings) {
  constexpr double kMaxBytes = 1 << 20;
  try {
    const auto text = store::read_whole(run / "scene.yaml", kMaxBytes);
    return {text.begin(), text.end()};
  } catch (const store::StoreError& error) {
    warnings.add(error.what());
    return "";
  }
}

}  // namespace

fs::path write_report(const fs::path& run, const Options& options) {
  const store::RunSummary summary = summary_of(run);
  Warnings warnings(options.warning);
  Page page;
  page.title = summary.title.empty() ? summary.scene : summary.title;
  page.scene_text = scene_text(run, warnings);
  page.frames = frames_html(run, summary, options.max_frames, warnings);
  page.measures = measures_html(summary);
  page.walls = walls_html(run, summary, warnings);
  page.figures = figures_html(run, warnings);
  page.files = file_names(run);
  std::erase_if(page.files, [](const std::string& name) { return !name.ends_with(".csv"); });
  const store::OutputFile file = options.file.empty()
                                     ? store::OutputFile{store::OutputFolder(run), "report.html"}
                                     : store::named_file(options.file);
  file.folder.write(file.name, to_html(page, summary, warnings), file.replace);
  return file.path();
}

}  // namespace clca::report
