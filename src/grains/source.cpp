#include <algorithm>
#include <numeric>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"

namespace clca::grains {

namespace {

std::uint16_t draw_kind(const State& state, const Source& source, std::uint32_t number) {
  const auto total =
      std::accumulate(source.weights.begin(), source.weights.end(), std::uint64_t{0});
  // Keyed by the number emitted so far: a waiting particle keeps its draw.
  const std::uint64_t bits =
      random::draw(state.seed, source.emitted, number, random::Purpose::source_species);
  std::uint64_t ticket = random::below(bits, total);
  std::uint16_t kind = 0;
  while (ticket >= source.weights[kind]) {
    ticket -= source.weights[kind++];
  }
  return kind;
}

/// Tries every site of the source once, starting at a random one.
bool emit_one(Box& box, Source& source, std::uint32_t number) {
  const State& state = box.state;
  Particle particle;
  particle.kind = draw_kind(state, source, number);
  const std::uint64_t bits = random::draw(state.seed, state.step + source.emitted, number,
                                          random::Purpose::source_position);
  const std::size_t start = random::below(bits, source.sites.size());
  for (std::size_t i = 0; i < source.sites.size(); ++i) {
    const lattice::Site site = source.sites[(start + i) % source.sites.size()];
    particle.column = site.column;
    particle.row = site.row;
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
