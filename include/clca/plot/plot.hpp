#pragma once
// Figures of a run folder, drawn by gnuplot from the tables that lie there.
//
// One template, one figure: plots/NAME.gp begins with comments that say what it needs, and reads
// the tables itself. docs/plots.md describes both.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace clca::plot {

/// A folder that is no run, has tables that cannot be read, or does not allow the figures that were
/// asked for. what() is one line.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// gnuplot or the templates are missing, or gnuplot fails. what() is one line.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Figure {
  std::string name;              ///< of the picture, without ending
  std::filesystem::path script;  ///< the template
  std::filesystem::path run;     ///< folder with the tables
  std::string setting;           ///< what the template asks about the tables, as gnuplot has it
};

struct Size {
  int width = 960;  ///< pixels
  int height = 600;
};

/// Folder of the templates: installed with the running program, or in the source tree. Throws
/// PlotError where there is neither.
std::filesystem::path template_folder();

/// The figures that the tables in `run` allow, by name; where `only` is not empty, those that it
/// names, by template or figure. Throws InputError, where a name in `only` is not among them too,
/// and PlotError where a template is not what it should be.
std::vector<Figure> figures(const std::filesystem::path& run, const std::vector<std::string>& only,
                            const std::filesystem::path& templates);

/// The figure as PNG: the same bytes for the same tables, gnuplot and fonts. Throws PlotError;
/// process::Stopped once `stop` is not zero.
std::vector<std::uint8_t> draw(const Figure& figure, const Size& size,
                               const std::atomic<int>* stop = nullptr);

}  // namespace clca::plot
