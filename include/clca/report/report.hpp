#pragma once
// The report of a run or a sweep: a self-contained HTML page.
// Made from the files of the folder alone: run.json or sweep.json, scene.yaml, tables, pictures.
// See docs/rendering.md.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace clca::report {

struct Options {
  /// Page to write; none: report.html in the folder.
  std::filesystem::path file;
  /// Maximum number of pictures of a run to step through; none: as many as keep the page below
  /// about 20 MB.
  std::optional<std::size_t> max_frames;
  /// Called with one line for each unreadable item left out.
  std::function<void(const std::string&)> warning;
};

/// Writes the page and returns its path. The same folder gives the same bytes.
/// Throws text::InputError if there is no readable run.json or sweep.json, and, if the page cannot
/// be written, store::StoreError; then nothing is written.
std::filesystem::path write_report(const std::filesystem::path& folder,
                                   const Options& options = {});

}  // namespace clca::report
