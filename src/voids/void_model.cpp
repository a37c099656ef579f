#include "clca/voids/void_model.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "voids/step.hpp"

namespace clca::voids {

namespace {

void check_able(const grains::State& state) {
  for (const grains::Kind& kind : state.kinds) {
    if (kind.shape.size() != 1) {
      throw std::invalid_argument("grains of the void model have one site");
    }
  }
  const bool moves = std::any_of(state.walls.begin(), state.walls.end(),
                                 [](const grains::Wall& wall) { return wall.motion.has_value(); });
  if (moves || !state.pushes.empty()) {
    throw std::invalid_argument("the void model has no walls that move");
  }
}

std::unique_ptr<grains::Mechanics> make_steps(grains::State state, const Rules& rules,
                                              const Options& options) {
  if (options.threads < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
  grains::check_valid(state);
  check_able(state);
  return std::make_unique<Steps>(std::move(state), rules);
}

}  // namespace

VoidModel::VoidModel(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

}  // namespace clca::voids
