#pragma once
// Fewer points that make the same line.

#include <cstddef>
#include <vector>

namespace clca::report {

/// Rows of a curve to draw, ascending, at most `most` (5 or more): all where there are no more;
/// else the first, the last, the least and the greatest of each of equal runs of rows, so that no
/// peak is lost (M4, Jugel et al. 2014), and a row without a value where a run has one.
std::vector<std::size_t> kept_rows(const std::vector<double>& y, std::size_t most);

}  // namespace clca::report
