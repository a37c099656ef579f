#include "grains/internal/one_site_steps.hpp"

namespace clca::grains {

namespace {

State valid(State state, const Options& options) {
  check_valid(options);
  check_valid(state);
  check_one_site(state);
  return state;
}

}  // namespace

OneSiteSteps::OneSiteSteps(State initial, const Options& options)
    : state_(valid(std::move(initial), options)), box_(state_) {
  for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
    if (state_.particles[id].previous != kRest) {
      moved_.push_back(id);
    }
  }
}

void OneSiteSteps::move(std::span<const std::pair<std::uint32_t, Move>> moves, StepReport& report) {
  for (const std::uint32_t id : moved_) {
    state_.particles[id].previous = kRest;
  }
  moved_.clear();
  for (const auto& [id, move] : moves) {
    Particle& particle = state_.particles[id];
    box_.occupancy.release(state_.lattice.index(particle.site()));
    particle = grains::moved(particle, static_cast<lattice::Direction>(move));
    particle.previous = move;
    box_.occupancy.take(state_.lattice.index(particle.site()), as_owner(id));
    moved_.push_back(id);
  }
  report.moved = moved_.size();
  ++state_.step;
}

}  // namespace clca::grains
