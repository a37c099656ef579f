#pragma once
// Which cache lines a step has to touch at least.

#include <cstdint>
#include <vector>

#include "clca/grains/state.hpp"
#include "grains/internal/box.hpp"

namespace clca::bench {

/// Cache lines that the moves of one step change: each is read and written once, however many
/// particles share it.
class Traffic {
 public:
  explicit Traffic(const grains::State& state);

  /// Of the step that has led to `state`: lines of the particles that moved, of the bits (see
  /// Bitboard) of the sites that they entered or left, and of the owners of those they entered.
  std::size_t lines(const grains::State& state);

 private:
  void mark(const grains::State& state, const grains::Particle& particle);
  void mark_bits(const grains::State& state, std::size_t place);

  grains::FootprintTable footprints_;
  std::size_t bit_lines_high_;  // of eight columns
  std::vector<bool> owners_;    // by line
  std::vector<bool> bits_;
  std::vector<bool> particles_;
};

}  // namespace clca::bench
