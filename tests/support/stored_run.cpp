#include "support/stored_run.hpp"

#include "clca/automaton/automaton.hpp"
#include "clca/run/run.hpp"
#include "clca/run/setup.hpp"
#include "clca/store/trajectory.hpp"
#include "run/stage.hpp"

namespace clca::testing {

store::RunSummary run_and_store(const scene::Scene& scene, const std::filesystem::path& folder,
                                std::uint64_t every) {
  const store::RunSummary summary = run::run(scene, {.folder = folder});
  automaton::Automaton automaton(run::initial_state(scene), scene.rules);
  store::TrajectoryWriter writer(store::OutputFolder(folder), scene, automaton.state(), {});
  for (std::size_t stage = 0; stage < summary.stages.size(); ++stage) {
    run::prepare_stage(automaton, scene, scene.stages[stage]);
    writer.add(automaton.state(), stage, true);
    const std::uint64_t steps = summary.stages[stage].steps;
    for (std::uint64_t step = 1; step <= steps; ++step) {
      automaton.step();
      if (step % every == 0 || step == steps) {
        writer.add(automaton.state(), stage, false);
      }
    }
  }
  writer.flush();
  return summary;
}

}  // namespace clca::testing
