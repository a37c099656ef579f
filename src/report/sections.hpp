#pragma once
// The pages of runs and sweeps, and their sections as HTML; empty if there is nothing to show.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clca/run/quantity.hpp"
#include "clca/store/summary.hpp"
#include "report/folder.hpp"

namespace clca::report {

/// A part of the page with its own heading.
struct Section {
  const char* id = "";
  const char* name = "";
  std::string content = {};  ///< HTML; left out if empty
};

struct Page {
  std::string title;                                            ///< of the scene
  std::string kind;                                             ///< of run, in words
  std::string status;                                           ///< `done` or another
  std::string scene;                                            ///< its name
  std::vector<std::pair<const char*, std::string>> facts = {};  ///< name and HTML
  std::vector<Section> sections = {};
};

std::string to_html(const Page& page, const Warnings& warnings);

/// Of a folder that a run has left. Throws text::InputError without a readable run.json.
Page run_page(const std::filesystem::path& run, std::optional<std::size_t> max_frames,
              Warnings& warnings);

/// Of a sweep. Throws text::InputError without a readable sweep.json and runs.csv.
Page sweep_page(const std::filesystem::path& folder, Warnings& warnings);

/// The names of the tables in a folder.
std::string files_html(const std::filesystem::path& folder);

/// The heading of a row of a table: name and meaning of a measure, as HTML.
std::string measure_heading(const std::string& key, const std::optional<run::ShownQuantity>& known);

/// Under tables of measures.
inline constexpr std::string_view kTurnedNote =
    "<p class=\"note\">Where a stage ends with a vessel that is turned, what is measured along or "
    "above its floor is left out.</p>\n";

/// A table of the measures, a row for each, a column for each stage.
std::string measures_html(const store::RunSummary& summary);

/// The tables of walls, with names and units of their columns.
std::string walls_html(const std::filesystem::path& run, const store::RunSummary& summary,
                       Warnings& warnings);

/// The figures of `clca plot` as SVG; without gnuplot a warning.
std::string figures_html(const std::filesystem::path& run, Warnings& warnings);

/// Pictures at the end of the stages, and those to step through: `most` or, without it, as many as
/// leave the page below some 20 MB.
std::string frames_html(const std::filesystem::path& run, const store::RunSummary& summary,
                        std::optional<std::size_t> most, Warnings& warnings);

}  // namespace clca::report
