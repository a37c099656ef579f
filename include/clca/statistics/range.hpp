#pragma once
// A range of numbers.

namespace clca::statistics {

struct Range {
  double low = 0;
  double high = 1;

  bool operator==(const Range&) const = default;
};

}  // namespace clca::statistics
