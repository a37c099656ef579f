#include "voids/step.hpp"

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
  // 1. Every void claims a grain. 2. Every grain that is claimed goes to one void.
  const auto claims = this->claims();
  std::vector<std::pair<std::uint32_t, grains::Move>> moves;
  for (std::uint32_t id = 0; id < claims.size(); ++id) {
    if (const grains::Move move = rule_.granted(id, claims[id]); move != grains::kRest) {
      moves.emplace_back(id, move);
    }
  }
  for (const std::uint32_t id : moved_) {
    state_.particles[id].previous = grains::kRest;
  }
  moved_.clear();
  // 3. All at once: a target was free when the step began, so no grain that moves leaves it.
  for (const auto& [id, move] : moves) {
    grains::Particle& grain = state_.particles[id];
    box_.occupancy.release(state_.lattice.index(grain.site()));
    grain = grains::moved(grain, static_cast<lattice::Direction>(move));
    grain.previous = move;
    box_.occupancy.take(state_.lattice.index(grain.site()), grains::as_owner(id));
    moved_.push_back(id);
  }
  report.moved = moved_.size();
  ++state_.step;
  return moved_.empty();
}

std::vector<std::array<bool, kDownward.size()>> Steps::claims() const {
  std::vector<std::array<bool, kDownward.size()>> result(state_.particles.size());
  const lattice::Lattice& lattice = state_.lattice;
  for (int column = 0; column < lattice.columns(); ++column) {
    for (int row = 0; row < lattice.rows(); ++row) {
      const lattice::Site site = {column, row};
      const grains::Owner grain =
          box_.occupancy.taken(lattice.index(site)) ? grains::kFree : rule_.claimed(site);
      for (std::size_t i = 0; grain != grains::kFree && i < kDownward.size(); ++i) {
        const std::size_t above = lattice.index(site + unit(opposite(kDownward[i])));
        if (box_.occupancy.owner(above) == grain) {
          result[grains::particle_id(grain)][i] = true;
        }
      }
    }
  }
  return result;
}

}  // namespace clca::voids
