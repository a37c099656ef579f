#pragma once
// The box cut into strips of columns, one for each thread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// From `first` to before `end`.
struct Columns {
  int first = 0;
  int end = 0;

  bool contains(int column) const { return column >= first && column < end; }
};

/// Cuts a box so that each strip has about as much to do as in the step before.
class Strips {
 public:
  Strips(const State& state, std::size_t count);

  /// Which strip the particles of a (wrapped) column belong to.
  std::size_t of(int column) const {
    std::size_t strip = 0;
    while (strip < cuts_.size() && column >= cuts_[strip]) {
      ++strip;
    }
    return strip;
  }
  /// Where the particles of a strip change no block of bits that those of another one look at or
  /// change, nor reach across the seam of a periodic box.
  Columns inner(std::size_t strip) const;
  /// The same where one strip is the whole box.
  Columns inner() const { return inner_of(0, columns_); }
  /// Whether particles there reach across the seam of a periodic box.
  bool at_seam(int column) const {
    return periodic_ && (column < reach_ || column >= columns_ - reach_);
  }

  /// Notes work in a column.
  static void note(std::vector<std::uint32_t>& load, int column, std::uint32_t amount) {
    load[static_cast<std::size_t>(column) / kBinColumns] += amount;
  }
  /// An empty record of work.
  std::vector<std::uint32_t> no_load() const;
  /// Cuts anew where the work has been; `loads` are emptied.
  void balance(std::span<std::vector<std::uint32_t>* const> loads);

 private:
  static constexpr std::size_t kBinColumns = 16;

  Columns inner_of(int first, int end) const;

  int columns_;
  bool periodic_;
  int reach_;
  std::vector<int> cuts_;  // first columns of the second strip and those after it
};

}  // namespace clca::automaton
