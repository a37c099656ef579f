#include "report/decimate.hpp"

#include <algorithm>
#include <cmath>

namespace clca::report {

namespace {

/// Rows of one run [begin, end) that matter.
void keep_of_run(const std::vector<double>& y, std::size_t begin, std::size_t end,
                 std::vector<std::size_t>& kept) {
  std::size_t least = begin;
  std::size_t greatest = begin;
  std::size_t gap = end;
  for (std::size_t row = begin; row < end; ++row) {
    if (std::isnan(y[row])) {
      gap = row;
      continue;
    }
    // Written so that a run that begins without a value takes the first one.
    least = !(y[least] <= y[row]) ? row : least;
    greatest = !(y[greatest] >= y[row]) ? row : greatest;
  }
  std::vector<std::size_t> rows = {begin, least, greatest, end - 1};
  if (gap < end) {
    rows.push_back(gap);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  kept.insert(kept.end(), rows.begin(), rows.end());
}

}  // namespace

std::vector<std::size_t> kept_rows(const std::vector<double>& y, std::size_t most) {
  constexpr std::size_t kOfRun = 5;
  std::vector<std::size_t> kept;
  const std::size_t runs = y.size() <= most ? y.size() : std::max<std::size_t>(most / kOfRun, 1);
  for (std::size_t run = 0; run < runs; ++run) {
    keep_of_run(y, y.size() * run / runs, y.size() * (run + 1) / runs, kept);
  }
  return kept;
}

}  // namespace clca::report
