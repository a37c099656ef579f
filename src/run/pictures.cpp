#include "run/pictures.hpp"

#include <utility>

namespace clca::run {

Pictures::Pictures(const scene::Scene& scene, const automaton::State& state)
    : scene_(scene), painter_(scene, state) {}

void Pictures::begin_stage(const std::string& stage, const automaton::State& state) {
  run::begin_stage(history_, stage, state);
}

void Pictures::draw(const automaton::Automaton& automaton, const Records& records,
                    const store::RunFolder& folder) {
  const automaton::State& state = automaton.state();
  if (history_.last_step == state.step) {
    return;
  }
  history_.last_step = state.step;
  Picture picture = painter_.draw({state, automaton.occupancy(), &records.cycles()}, history_);
  writer_.write(folder.frame(scene_.name, state.step), std::move(picture.image),
                std::move(picture.text));
}

}  // namespace clca::run
