#include "traffic.hpp"

#include <algorithm>

#include "grains/internal/bitboard.hpp"
#include "machine.hpp"

namespace clca::bench {

namespace {

using grains::Particle;
using grains::State;

constexpr std::size_t kOwnersInALine = kLine / sizeof(grains::Owner);
// A byte has eight sites of a row; the bytes of rows follow each other.
constexpr std::size_t kLineColumns = grains::kWindow;
constexpr std::size_t kLineRows = kLine;

std::size_t lines_of(std::size_t bytes) {
  return bytes / kLine + 1;
}

/// Where the particle stood before its last move.
Particle before(Particle particle) {
  const auto direction = static_cast<lattice::Direction>(particle.previous);
  const lattice::Site site = particle.site() + (lattice::Axial{} - unit(direction));
  particle.column = site.column;
  particle.row = site.row;
  return particle;
}

std::size_t take(std::vector<bool>& lines) {
  const auto count = std::count(lines.begin(), lines.end(), true);
  lines.assign(lines.size(), false);
  return static_cast<std::size_t>(count);
}

}  // namespace

Traffic::Traffic(const State& state)
    : footprints_(state),
      bit_lines_high_(static_cast<std::size_t>(state.lattice.rows()) / kLineRows + 2),
      owners_(state.lattice.index_count() / kOwnersInALine + 1),
      bits_((static_cast<std::size_t>(state.lattice.columns()) / kLineColumns + 2) *
            bit_lines_high_),
      particles_(lines_of(state.particles.size() * sizeof(Particle))) {}

void Traffic::mark(const State& state, const Particle& particle) {
  const Particle from = before(particle);
  const grains::Footprint& footprint = footprints_.footprint(from);
  const std::size_t reference = state.lattice.index(from.site());
  const int column = state.lattice.wrapped(from.column);
  for (const lattice::IndexOffset offset : footprint.lead_sites[particle.previous]) {
    const std::size_t place = state.lattice.shifted_index(reference, column, offset);
    owners_[place / kOwnersInALine] = true;
    mark_bits(state, place);
  }
  for (const lattice::IndexOffset offset : footprint.trail_sites[particle.previous]) {
    mark_bits(state, state.lattice.shifted_index(reference, column, offset));
  }
}

void Traffic::mark_bits(const State& state, std::size_t place) {
  const lattice::Site site = state.lattice.site(place);
  bits_[static_cast<std::size_t>(site.column) / kLineColumns * bit_lines_high_ +
        static_cast<std::size_t>(site.row) / kLineRows] = true;
}

std::size_t Traffic::lines(const State& state) {
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    const Particle& particle = state.particles[id];
    if (particle.present && particle.previous != grains::kRest) {
      particles_[id * sizeof(Particle) / kLine] = true;
      mark(state, particle);
    }
  }
  return take(owners_) + take(bits_) + take(particles_);
}

}  // namespace clca::bench
