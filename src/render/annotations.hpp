#pragma once
// Captions, legend and scale bar around the view of a finished picture.

#include <optional>
#include <string>
#include <vector>

#include "clca/render/painter.hpp"
#include "render/font.hpp"
#include "render/layout.hpp"

namespace clca::render {

/// Largest of 1, 2 and 5 times a power of ten not above `length` (positive).
double round_length(double length);

/// A length given in metres, written in the largest of m, mm and µm that makes it at least 1.
std::string metres_text(double length);

/// Round numbers from `low` to `high`, at most `count` of them.
std::vector<double> ticks(double low, double high, int count);

class Annotator {
 public:
  /// Throws RenderError when there is no font.
  Annotator() = default;

  /// `fade`: as Overlay::fade, for the colours of the legend.
  void draw(Image& image, const Layout& layout, const Caption& caption, const Legend& legend,
            double fade = 0);

 private:
  // In text sizes.
  static constexpr double kLegendMiddle = 1.1;  // down from the lower edge of the view
  static constexpr double kHalfLetter = 0.36;   // from the middle of a line down to its baseline
  static constexpr double kGap = 1.5;  // at least, between what stands on the left and on the right

  /// A legend entry: a colour patch or stroke, and its label.
  struct Entry {
    std::string label;
    double mark_width = 0;  ///< pixels
    Rgb color = {};
    std::optional<Stroke> stroke = {};
  };

  void draw_caption(const Caption& caption);
  /// Returns its left end.
  double draw_scale_bar(double spacing);
  double draw_color_bar(const Legend::Bar& bar, double left, double right);
  Stroke key_stroke(const Legend::Line& line) const;
  std::vector<Entry> entries_of(const Legend& legend) const;
  void draw_mark(const Entry& entry, double left, double middle);
  void draw_entries(const Legend& legend, double left, double right);
  double em(double text_sizes) const { return text_sizes * layout_.text_size; }
  double below_panel(double text_sizes) const {
    return layout_.panel.y + layout_.panel.height + em(text_sizes);
  }

  Font font_;
  Image* image_ = nullptr;
  Layout layout_;
  double fade_ = 0;
};

}  // namespace clca::render
