#include "clca/voids/void_model.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "voids/step.hpp"

namespace clca::voids {

namespace {

std::unique_ptr<grains::Mechanics> make_steps(grains::State state, const Rules& rules,
                                              const Options& options) {
  if (options.threads < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
  grains::check_valid(state);
  grains::check_one_site(state);
  return std::make_unique<Steps>(std::move(state), rules);
}

}  // namespace

VoidModel::VoidModel(grains::State state, const Rules& rules, const Options& options)
    : Model(make_steps(std::move(state), rules, options)) {}

}  // namespace clca::voids
