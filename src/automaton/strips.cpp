#include "automaton/strips.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "clca/automaton/site_bits.hpp"

namespace clca::automaton {

namespace {

/// Columns from the reference site of a particle to the furthest that its move looks at or changes:
/// those that it enters or leaves, those who wake beyond, and what else is in their blocks of bits.
int furthest(const State& state) {
  constexpr int kBeyond = 3 + 2 * kWindow;
  int most = 0;
  for (const Kind& kind : state.kinds) {
    for (const lattice::Axial part : kind.shape.sites()) {
      most = std::max(most, std::abs(part.x));
    }
  }
  return most + kBeyond;
}

}  // namespace

Strips::Strips(const State& state, std::size_t count)
    : columns_(state.lattice.columns()),
      periodic_(state.lattice.periodic()),
      reach_(furthest(state)) {
  for (std::size_t strip = 1; strip < count; ++strip) {
    cuts_.push_back(static_cast<int>(static_cast<std::size_t>(columns_) * strip / count));
  }
}

Columns Strips::inner_of(int first, int end) const {
  const bool left_end = first == 0 && !periodic_;
  const bool right_end = end == columns_ && !periodic_;
  // Others reach over a cut as far as one's own.
  return {.first = left_end ? first : first + 2 * reach_,
          .end = right_end ? end : end - 2 * reach_};
}

Columns Strips::inner(std::size_t strip) const {
  return inner_of(strip == 0 ? 0 : cuts_[strip - 1],
                  strip == cuts_.size() ? columns_ : cuts_[strip]);
}

std::vector<std::uint32_t> Strips::no_load() const {
  std::vector<std::uint32_t> load;
  load.resize(static_cast<std::size_t>(columns_) / kBinColumns + 1, 0);
  return load;
}

void Strips::balance(std::span<std::vector<std::uint32_t>* const> loads) {
  std::vector<std::uint32_t>& sum = *loads.front();
  std::uint64_t total = 0;
  for (std::size_t bin = 0; bin < sum.size(); ++bin) {
    for (std::vector<std::uint32_t>* load : loads.subspan(1)) {
      sum[bin] += std::exchange((*load)[bin], 0);
    }
    total += sum[bin];
  }
  std::uint64_t done = 0;
  std::size_t cut = 0;
  for (std::size_t bin = 0; bin < sum.size(); ++bin) {
    while (cut < cuts_.size() && done >= total * (cut + 1) / (cuts_.size() + 1)) {
      cuts_[cut++] = static_cast<int>(bin * kBinColumns);
    }
    done += std::exchange(sum[bin], 0);
  }
  for (; cut < cuts_.size(); ++cut) {
    cuts_[cut] = columns_;
  }
}

}  // namespace clca::automaton
