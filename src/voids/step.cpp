#include "voids/step.hpp"

#include <map>
#include <utility>

namespace clca::voids {

Steps::Steps(grains::State initial, const Rules& rules)
    : state_(std::move(initial)), box_(state_), rule_(box_, rules) {
  for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
    if (state_.particles[id].previous != grains::kRest) {
      moved_.push_back(id);
    }
  }
}

bool Steps::advance(grains::StepReport& report) {
  const std::vector<GrainMove> moves = granted_moves();
  for (const std::uint32_t id : moved_) {
    state_.particles[id].previous = grains::kRest;
  }
  moved_.clear();
  // All at once: a target was free when the step began, so no grain that moves leaves it.
  for (const GrainMove& one : moves) {
    grains::Particle& grain = state_.particles[one.id];
    const lattice::Site from = grain.site();
    grain = grains::moved(grain, static_cast<lattice::Direction>(one.move));
    grain.previous = one.move;
    box_.occupancy.release(state_.lattice.index(from));
    box_.occupancy.take(state_.lattice.index(grain.site()), grains::as_owner(one.id));
    moved_.push_back(one.id);
    vacated(from);
  }
  report.moved = moved_.size();
  ++state_.step;
  return moved_.empty();
}

std::vector<GrainMove> Reference::granted_moves() {
  // Every void claims a grain.
  std::map<std::uint32_t, std::array<bool, kDownward.size()>> claims;
  const lattice::Lattice& lattice = state().lattice;
  for (int column = 0; column < lattice.columns(); ++column) {
    for (int row = 0; row < lattice.rows(); ++row) {
      const lattice::Site site = {column, row};
      const grains::Owner grain =
          box().occupancy.taken(lattice.index(site)) ? grains::kFree : rule().claimed(site);
      for (std::size_t i = 0; grain != grains::kFree && i < kDownward.size(); ++i) {
        const std::size_t above = lattice.index(site + unit(opposite(kDownward[i])));
        if (box().occupancy.owner(above) == grain) {
          claims[static_cast<std::uint32_t>(grain)][i] = true;
        }
      }
    }
  }
  // Every grain that is claimed goes to one void.
  std::vector<GrainMove> moves;
  for (const auto& [id, by] : claims) {
    moves.push_back({id, rule().granted(id, by)});
  }
  return moves;
}

}  // namespace clca::voids
