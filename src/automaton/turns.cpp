#include "automaton/turns.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace clca::automaton {

namespace {

constexpr unsigned kTieBits = 64;
constexpr unsigned kPileBits = 8;
constexpr std::size_t kPiles = UpdateOrder::kRanks << kPileBits;

std::size_t pile_of(const UpdateKey& key) {
  return static_cast<std::size_t>(key.rank << kPileBits | key.tie >> (kTieBits - kPileBits));
}

bool before(const Turn& one, const Turn& other) {
  return one.key < other.key;
}

}  // namespace

// To compare keys that are drawn at random is slow, as nobody can guess how it ends. Piles of some
// that are about equal need few comparisons.
void sort(std::vector<Turn>& turns) {
  constexpr std::size_t kFew = 256;
  if (turns.size() <= kFew) {
    std::sort(turns.begin(), turns.end(), before);
    return;
  }
  std::array<std::size_t, kPiles + 1> begins{};
  for (const Turn& turn : turns) {
    ++begins[pile_of(turn.key) + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<Turn> sorted(turns.size());
  std::array<std::size_t, kPiles + 1> ends = begins;
  for (const Turn& turn : turns) {
    sorted[ends[pile_of(turn.key)]++] = turn;
  }
  for (std::size_t pile = 0; pile < kPiles; ++pile) {
    const auto first = sorted.begin();
    std::sort(first + static_cast<std::ptrdiff_t>(begins[pile]),
              first + static_cast<std::ptrdiff_t>(ends[pile]), before);
  }
  turns.swap(sorted);
}

void merge(std::vector<Turn>& all, const std::vector<Turn>& more) {
  const auto middle = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), more.begin(), more.end());
  std::inplace_merge(all.begin(), all.begin() + middle, all.end(), before);
}

}  // namespace clca::automaton
