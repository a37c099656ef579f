#include "render/annotations.hpp"

namespace clca::render {

namespace {

/// Places items one after the other, line by line.
class Line {
 public:
  Line(double gap, std::span<const double> rooms) : gap_(gap), rooms_(rooms) {}

  /// Returns false if there is no space left.
  bool add(std::optional<std::size_t> entry, double width) {
    while (line_ < rooms_.size() && left_ + width > rooms_[line_]) {
      ++line_;
      left_ = 0;
    }
    if (line_ == rooms_.size()) {
      return false;
    }
    items_.push_back({entry, left_, static_cast<int>(line_)});
    left_ += width + gap_;
    return true;
  }

  /// The first `count` of the entries.
  bool add_first(std::size_t count, std::span<const double> widths) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!add(i, widths[i])) {
        return false;
      }
    }
    return true;
  }

  const std::vector<LegendItem>& items() const { return items_; }

 private:
  double gap_;
  std::span<const double> rooms_;
  double left_ = 0;
  std::size_t line_ = 0;
  std::vector<LegendItem> items_;
};

}  // namespace

std::vector<LegendItem> placed_legend_items(std::span<const double> widths, double ellipsis,
                                            double gap, std::span<const double> rooms) {
  Line whole(gap, rooms);
  if (whole.add_first(widths.size(), widths)) {
    return whole.items();
  }
  for (std::size_t kept = widths.size() - 1; kept-- > 0;) {
    Line line(gap, rooms);
    if (line.add_first(kept, widths) && line.add(std::nullopt, ellipsis) &&
        line.add(widths.size() - 1, widths.back())) {
      return line.items();
    }
  }
  Line none(gap, rooms);
  none.add(std::nullopt, ellipsis);
  return none.items();
}

}  // namespace clca::render
