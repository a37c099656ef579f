#pragma once
// Figures of a run folder, drawn by gnuplot from its tables.
// A template plots/NAME.gp starts with comments that list what it needs, and reads the tables
// itself. See docs/rendering.md.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace clca::plot {

/// gnuplot or the templates are missing, or gnuplot fails. what() is one line.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Figure {
  std::string name;              ///< of the picture, without ending
  std::string title;             ///< above it: that of the scene
  std::string description;       ///< what it shows, in a sentence or two
  std::filesystem::path script;  ///< the template
  std::filesystem::path run;     ///< folder with the tables
  std::string setting;           ///< gnuplot variables that describe the tables
  double rank = 0;               ///< what a report shows first has the highest
};

/// What is drawn in place of all that the tables allow. Of a sweep: keys that vary and measures; of
/// a run: columns of one table.
struct Choice {
  std::string x = {};               ///< empty: the first key, or time
  std::vector<std::string> y = {};  ///< a figure for each; empty: all measures
  /// Keys with a curve for each value; empty: all but `x`. The others have figures of their own.
  std::vector<std::string> over = {};
  bool log_x = false;  ///< logarithmic axes
  bool log_y = false;
};

enum class Format : std::uint8_t { png, svg, pdf };

/// The ending of file names.
const char* ending(Format format);

struct Appearance {
  Format format = Format::png;
  bool in_mm = false;                 ///< width and height in millimetres, with letters of 8 points
  double width = 960;                 ///< pixels; 96 are an inch of a PDF
  std::optional<double> height = {};  ///< none: as the figure needs
};

/// Folder of the templates that come with the program. Throws PlotError if there is none.
std::filesystem::path template_folder();

/// The figures that the tables in `run` allow, by name; if `only` is not empty, those named there
/// by template or figure. Of a run, a choice has to name columns for `y`.
/// Throws text::InputError if the folder is no run, has unreadable tables or does not allow a
/// figure, also for unknown names, and PlotError for an invalid template.
std::vector<Figure> figures(const std::filesystem::path& run, const std::vector<std::string>& only,
                            const std::filesystem::path& templates, const Choice& choice = {});

/// The figures that the readable tables in `run` allow, the most telling first; none is no error.
/// `warning` is called with one line for each template whose tables are invalid. Throws as
/// figures().
std::vector<Figure> figures_of_readable_tables(
    const std::filesystem::path& run, const std::filesystem::path& templates,
    const std::function<void(const std::string&)>& warning);

/// The same bytes for the same tables, gnuplot and fonts. Throws PlotError, and
/// process::StoppedError once `stop` is not zero.
std::vector<std::uint8_t> draw(const Figure& figure, const Appearance& appearance,
                               const std::atomic<int>* stop = nullptr);

}  // namespace clca::plot
