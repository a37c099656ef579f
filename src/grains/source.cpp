#include <algorithm>

#include "grains/internal/filling.hpp"

namespace clca::grains {

namespace {

/// Tries every site of the source once, starting at a random one.
bool emit_one(Box& box, Source& source, std::uint32_t number) {
  const State& state = box.state;
  // Keyed by the number emitted so far: a waiting particle keeps its draw.
  const std::size_t kind = drawn_index(
      source.weights,
      random::draw(state.seed, source.emitted, number, random::Purpose::source_species));
  const std::uint64_t bits = random::draw(state.seed, state.step + source.emitted, number,
                                          random::Purpose::source_position);
  const std::size_t start = random::below(bits, source.sites.size());
  for (std::size_t i = 0; i < source.sites.size(); ++i) {
    const lattice::Site site = source.sites[(start + i) % source.sites.size()];
    const Particle particle = {
        .column = site.column, .row = site.row, .kind = static_cast<std::uint16_t>(kind)};
    if (fits(box, particle)) {
      insert(box, particle);
      ++source.emitted;
      return true;
    }
  }
  return false;
}

/// False if the source is exhausted or the particle does not fit.
bool run_source(Box& box, Source& source, std::uint32_t number) {
  source.credit = std::min(source.credit, source.unit) + source.rate;
  while (source.credit >= source.unit && !source.exhausted()) {
    if (!emit_one(box, source, number)) {
      return false;
    }
    source.credit -= source.unit;
  }
  return !source.exhausted();
}

}  // namespace

bool run_sources(Box& box) {
  bool waits = false;
  for (std::size_t number = 0; number < box.state.sources.size(); ++number) {
    Source& source = box.state.sources[number];
    if (source.open && !source.exhausted()) {
      waits = run_source(box, source, static_cast<std::uint32_t>(number)) || waits;
    }
  }
  return waits;
}

}  // namespace clca::grains
