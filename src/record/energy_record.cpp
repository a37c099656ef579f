#include "record/energy_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace clca::record {

void UnsettledBedDetector::begin_anew() {
  movers_.clear();
  steps_ = 0;
  has_advanced_ = false;
}

void UnsettledBedDetector::add_move(const grains::State& state, std::uint32_t id) {
  const grains::Particle& grain = state.particles[id];
  const auto mover = std::ranges::find(movers_, id, &Mover::id);
  const bool is_known = mover != movers_.end();
  constexpr int kMostRise = 3;  // rows; what rises farther flies
  if (is_known && grain.row >= mover->lowest && grain.row <= mover->lowest + kMostRise) {
    ++mover->moves;
    if (lattice::length_in_steps(grain.site() - lattice::Site{mover->column, mover->row}) > 1) {
      mover->column = grain.column;
      mover->row = grain.row;
      has_advanced_ = true;
    }
    return;
  }
  if (is_known || movers_.size() == kMaxMovers) {
    begin_anew();
  }
  movers_.push_back({id, grain.column, grain.row, grain.row, 1});
}

std::optional<std::string> UnsettledBedDetector::add_step(const scene::Scene& scene,
                                                          const grains::State& state,
                                                          std::size_t moved) {
  const bool has_left = std::ranges::any_of(
      movers_, [&](const Mover& mover) { return !state.particles[mover.id].present; });
  if (has_warned_ || moved > kMaxMovers || has_left) {
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
  if (steps_ < kMinSteps || !has_advanced_) {
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

bool UnsettledBedDetector::precedes(const grains::State& state) const {
  return movers_.size() <= kMaxMovers && std::ranges::all_of(movers_, [&](const Mover& mover) {
           return mover.id < state.particles.size();
         });
}

void EnergyRecord::begin(const scene::Stage& stage, const model::SceneModel& model) {
  is_closed_ =
      stage.open_sources.empty() && stage.moving_walls.empty() && !model.vessel().is_moving();
  start_ = model.contact()->energy().sum();
  fall_ = 0;
  for (const grains::Particle& particle : model.state().particles) {
    fall_ += particle.present ? static_cast<double>(model.state().shape(particle).size()) : 0;
  }
  exchanged_ = {};
  lowest_ = start_;
  growth_ = 0;
  rest_ = {};
}

void EnergyRecord::after_step(const StageView& now) {
  if (now.model.contact()->last_step().had_too_fast_grain &&
      !std::exchange(has_been_too_fast_, true)) {
    now.warn(
        fmt::format("stage {}, step {}: a grain falls faster than it can move, and loses velocity; "
                    "choose a larger contact.fall_height",
                    now.stage.name, now.model.state().step));
  }
  if (const auto text = add_step(now.model, now.model.contact()->last_step().exchange)) {
    now.warn(fmt::format("stage {}, step {}: {}", now.stage.name, now.model.state().step, *text));
  }
  if (!is_closed_ || scene::fixed_steps(now.stage.until)) {
    return;
  }
  if (const auto text = rest_.add_step(now.scene, now.model.state(), now.moving_particles)) {
    now.warn(fmt::format("stage {}, step {}: {}; the stage goes on up to max_steps ({})",
                         now.stage.name, now.model.state().step, *text, now.stage.max_steps));
  }
}

std::optional<std::string> EnergyRecord::add_step(const model::SceneModel& model,
                                                  const contact::EnergyExchange& exchange) {
  exchanged_ += exchange;
  if (!is_closed_) {
    return std::nullopt;
  }
  const contact::Energy energy = model.contact()->energy();
  const double now = energy.sum() - exchanged_.gained();
  lowest_ = std::min(lowest_, now);
  // On a slope without end the potential energy falls without end, below 0.
  const double scale = std::max({start_, fall_, start_ - lowest_, energy.kinetic});
  if (scale <= 0) {
    return std::nullopt;
  }
  growth_ = std::max(growth_, (now - lowest_) / scale);
  constexpr double kTolerance = 0.01;  // a bed that lands gives back 0.5 % for some steps
  if (has_warned_ || growth_ <= kTolerance) {
    return std::nullopt;
  }
  has_warned_ = true;
  return fmt::format(
      "kinetic and potential energy have grown from {:.0f} to {:.0f}, by {:.1f} % of the {:.0f} at "
      "the start of the stage or dissipated since; choose a smaller contact.resolution",
      lowest_, now, 100 * (now - lowest_) / scale, scale);
}

double EnergyRecord::dissipated_energy(const contact::Energy& now) const {
  return start_ + exchanged_.gained() - now.sum();
}

std::optional<double> EnergyRecord::energy_growth() const {
  return is_closed_ ? std::optional(growth_) : std::nullopt;
}

ObserverFactory energy_observer() {
  return observer_factory<EnergyRecord>(
      is_contact_model, {},
      {{{},
        "model `contact`, stages without sources in which neither walls nor the vessel move",
        {{"energy_growth", "Growth of the energy", "",
          "most that it has grown in the stage, as a share of that at its start"}},
        [](const StageView& stage) -> MeasureValues {
          const auto* energy = stage.observers.find<EnergyRecord>();
          const auto growth = energy != nullptr ? energy->energy_growth() : std::nullopt;
          return growth ? MeasureValues{*growth} : MeasureValues{};
        }}});
}

}  // namespace clca::record
