#include "clca/baxter/baxter_model.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "baxter/step.hpp"

namespace clca::baxter {

namespace {

std::unique_ptr<grains::Mechanics> make_steps(grains::State state, const Rules& rules,
                                              const Options& options) {
  if (options.threads < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
  grains::check_valid(state);
  grains::check_one_site(state);
  for (std::size_t kind = 0; kind < state.kinds.size(); ++kind) {
    if (state.kinds.size() % kAxes != 0 || state.kinds[kind].species != kind / kAxes) {
      throw std::invalid_argument("a species of the Baxter model has a kind for each axis");
    }
  }
  return std::make_unique<Steps>(std::move(state), rules);
}

}  // namespace

std::vector<grains::Kind> kinds_along_axes(std::uint16_t species) {
  return std::vector<grains::Kind>(kAxes, {lattice::Shape::hexagon(0), species});
}

BaxterModel::BaxterModel(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

}  // namespace clca::baxter
