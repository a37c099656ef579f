#include "record/rest_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clca::record {

void RestWatch::begin_anew() {
  movers_.clear();
  steps_ = 0;
  has_advanced_ = false;
}

void RestWatch::add_move(const grains::State& state, std::uint32_t id) {
  const grains::Particle& grain = state.particles[id];
  const auto is_it = [id](const Mover& one) { return one.id == id; };
  auto mover = std::ranges::find_if(movers_, is_it);
  if (mover == movers_.end() && movers_.size() == kMostMovers) {
    begin_anew();
    mover = movers_.end();
  }
  if (mover == movers_.end()) {
    movers_.push_back({id, grain.column, grain.row, grain.row, 1});
    return;
  }
  ++mover->moves;
  if (lattice::length(grain.site() - lattice::Site{mover->column, mover->row}) > 1) {
    mover->column = grain.column;
    mover->row = grain.row;
    has_advanced_ = true;
  }
  if (grain.row < mover->lowest) {
    const Mover kept = {id, grain.column, grain.row, grain.row, 1};
    begin_anew();
    movers_ = {kept};
  }
}

std::optional<std::string> RestWatch::add(const scene::Scene& scene, const grains::State& state,
                                          std::size_t moved) {
  const bool has_left = std::ranges::any_of(
      movers_, [&](const Mover& mover) { return !state.particles[mover.id].present; });
  if (has_warned_ || moved > kMostMovers || has_left) {
    begin_anew();
    return std::nullopt;
  }
  ++steps_;
  for (std::uint32_t id = 0; moved > 0 && id < state.particles.size(); ++id) {
    if (state.particles[id].present && state.particles[id].previous != grains::kRest) {
      add_move(state, id);
    }
  }
  if (movers_.empty()) {
    steps_ = 0;
  }
  if (steps_ < kSteps || !has_advanced_) {
    return std::nullopt;
  }
  has_warned_ = true;
  std::string text = fmt::format("no rest: for {} steps nothing has moved but", steps_);
  for (const Mover& mover : movers_) {
    const grains::Particle& grain = state.particles[mover.id];
    const Eigen::Vector2d centre = grains::centre_in_box(state, grain);
    text += fmt::format("{} particle {} ({}) at x = {:.1f}, y = {:.1f}, {} times",
                        &mover == movers_.data() ? "" : ",", mover.id,
                        scene.species[state.kinds[grain.kind].species].name, centre.x(), centre.y(),
                        mover.moves);
  }
  return text;
}

bool RestWatch::precedes(const grains::State& state) const {
  return movers_.size() <= kMostMovers && std::ranges::all_of(movers_, [&](const Mover& mover) {
           return mover.id < state.particles.size();
         });
}

}  // namespace clca::record
