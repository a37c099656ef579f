#pragma once
// Figures of a run, a gas or a sweep, drawn by the Python package from the tables in its folder.
// See docs/rendering.md; src/python/clca/_figures.py lists them.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace clca::plot {

/// Python, a module of it or the package is missing, or it fails. what() is one line.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is drawn in place of all that the tables allow. Of a sweep: keys that vary and measures; of
/// a run: columns of one table.
struct Choice {
  std::string x = {};               ///< empty: the first key, or time
  std::vector<std::string> y = {};  ///< a figure for each; empty: all
  /// Keys with curves for their values; empty: all but `x`. The others have figures of their own.
  std::vector<std::string> over = {};
  std::string y2 = {};                   ///< of a run: a column on a second axis
  std::string log = {};                  ///< logarithmic axes: x, y or xy
  std::vector<std::string> stages = {};  ///< empty: all
  std::optional<double> first = {};      ///< of the time, or of the step where there is no time
  std::optional<double> last = {};
  bool filling = true;     ///< also stages that fill the box
  std::uint64_t mean = 1;  ///< running mean over so many rows
};

using Limits = std::pair<std::optional<double>, std::optional<double>>;

struct Appearance {
  std::string format = "png";         ///< or svg, pdf
  bool in_mm = false;                 ///< width and height in millimetres, with letters of 8 points
  double width = 960;                 ///< pixels; 96 are an inch
  std::optional<double> height = {};  ///< none: as the figure needs
  Limits x_limits = {};               ///< of the axes; none: as the data need
  Limits y_limits = {};
};

struct Picture {
  std::string name;   ///< of the figure
  std::string about;  ///< what it shows, in a sentence or two
  std::string format;
  std::vector<std::uint8_t> bytes;
};

/// The figures that the tables in `folder` allow; if `only` is not empty, those named there. The
/// same bytes for the same tables, matplotlib and fonts. Throws text::InputError for a folder that
/// is no run or sweep, tables that cannot be read and names that are not there, PlotError, and
/// process::StoppedError once `stop` is not zero.
std::vector<Picture> pictures(const std::filesystem::path& folder,
                              const std::vector<std::string>& only, const Choice& choice = {},
                              const Appearance& appearance = {},
                              const std::atomic<int>* stop = nullptr);

/// For a page: so many at most, the most telling first, without titles, and warnings about tables
/// that cannot be read. What is large as SVG is PNG. Throws as above.
std::pair<std::vector<Picture>, std::vector<std::string>> pictures_of_page(
    const std::filesystem::path& folder, const Appearance& appearance, std::size_t most);

}  // namespace clca::plot
