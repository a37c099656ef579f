#include "run/series.hpp"

#include "clca/measure/outflow.hpp"

namespace clca::run {

namespace {

double mean_height(const automaton::State& state) {
  double sum = 0;
  double weight = 0;
  for (const automaton::Particle& particle : state.particles) {
    if (particle.present) {
      const auto sites = static_cast<double>(state.shape(particle).size());
      sum += sites * automaton::centre(state, particle).y();
      weight += sites;
    }
  }
  return weight > 0 ? sum / weight : 0;
}

}  // namespace

SeriesTable::SeriesTable(const scene::Series& series)
    : every_(series.every),
      table_({"step", "stage", "particles", "moving", "moving_share", "mean_height",
              "discharged_particles", "discharged_sites"}) {}

void SeriesTable::add(const std::string& stage, const automaton::State& state, std::size_t moving,
                      bool always) {
  if ((!always && state.step % every_ != 0) || last_step_ == state.step) {
    return;
  }
  last_step_ = state.step;
  const std::uint64_t present = automaton::present_count(state);
  const measure::Discharge out = measure::discharge(state);
  const double share =
      present > 0 ? static_cast<double>(moving) / static_cast<double>(present) : 0.0;
  table_.add_row({state.step, stage, present, std::uint64_t{moving}, share, mean_height(state),
                  out.particles, out.sites});
}

}  // namespace clca::run
