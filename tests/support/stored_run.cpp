#include "support/stored_run.hpp"

#include "clca/run/run.hpp"
#include "clca/store/trajectory.hpp"
#include "run/stage.hpp"

namespace clca::testing {

store::RunSummary run_and_store(const scene::Scene& scene, const std::filesystem::path& folder,
                                std::uint64_t every) {
  store::RunSummary summary = run::run(scene, {.folder = folder});
  model::SceneModel model(scene, run::state_at_start(scene), {});
  store::TrajectoryWriter writer(store::OutputFolder(folder), scene, model.state(), {});
  for (std::size_t stage = 0; stage < summary.stages.size(); ++stage) {
    run::prepare_stage(model, scene, stage);
    writer.add_frame(model.state(), stage, true,
                     {.velocities = model.velocities(), .spins = model.spins()});
    const std::uint64_t steps = summary.stages[stage].steps;
    for (std::uint64_t step = 1; step <= steps; ++step) {
      model.grains().step();
      if (step % every == 0 || step == steps) {
        writer.add_frame(model.state(), stage, false,
                         {.velocities = model.velocities(), .spins = model.spins()});
      }
    }
  }
  writer.flush();
  return summary;
}

}  // namespace clca::testing
