#pragma once
// The report of a run: one page that needs nothing beside it.
//
// Made from what lies in the run folder alone: run.json, scene.yaml, tables and pictures.
// docs/report.md describes the page.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace clca::report {

/// A folder that is no run: without run.json, or with one that cannot be read. what() is one line.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Options {
  /// Page to write; none: report.html in the run folder.
  std::filesystem::path file;
  /// Most pictures to step through; none: as many as leave the page below some 20 MB.
  std::optional<std::size_t> most_frames;
  /// Told in one line each what is left out of the page because it cannot be read.
  std::function<void(const std::string&)> warning;
};

/// Writes the page and returns its path. The same folder gives the same bytes. Throws InputError,
/// and store::StoreError where the page cannot be written; then nothing is written.
std::filesystem::path write_report(const std::filesystem::path& run, const Options& options = {});

}  // namespace clca::report
