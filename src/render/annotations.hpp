#pragma once
// Captions, legend and scale bar around the view of a finished picture.

#include "clca/render/painter.hpp"
#include "render/font.hpp"
#include "render/layout.hpp"

namespace clca::render {

/// Largest of 1, 2 and 5 times a power of ten that is not above `length` (which is positive).
double round_length(double length);

/// Round numbers from `low` to `high`, at most `count` of them.
std::vector<double> ticks(double low, double high, int count);

class Annotator {
 public:
  /// Throws RenderError when there is no font.
  Annotator() = default;

  void draw(Image& image, const Layout& layout, const Caption& caption, const Legend& legend);

 private:
  void draw_caption(const Caption& caption);
  /// Returns the left end, to keep clear of.
  double draw_scale_bar();
  double draw_color_bar(const Legend::Bar& bar, double left, double right);
  void draw_patches(const std::vector<Legend::Patch>& patches, double left, double right);
  double em(double text_sizes) const { return text_sizes * layout_.text_size; }
  double below_panel(double text_sizes) const {
    return layout_.panel.y + layout_.panel.height + em(text_sizes);
  }

  Font font_;
  Image* image_ = nullptr;
  Layout layout_;
};

}  // namespace clca::render
