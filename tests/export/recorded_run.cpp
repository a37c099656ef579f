#include "export/recorded_run.hpp"

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "run/stage.hpp"

namespace clca::testing {

void record(const std::string& scene_text, const std::filesystem::path& folder, int steps,
            int every) {
  const scene::Scene scene = scene::parse(scene_text, "recorded.yaml");
  std::filesystem::create_directories(folder);
  store::write_whole(folder / "scene.yaml", scene::to_yaml(scene));
  store::RunSummary summary = run::provenance();
  summary.scene = scene.name;
  summary.status = "done";
  store::write_whole(folder / "run.json", store::to_json(summary));
  run::SceneModel model(scene, run::first_state(scene), {});
  store::TrajectoryWriter writer(store::OutputFolder(folder), scene, model.state(), {});
  for (std::size_t stage = 0; stage < scene.stages.size(); ++stage) {
    run::prepare_stage(model, scene, scene.stages[stage]);
    writer.add(model.state(), stage, true,
               {.velocities = model.velocities(), .spins = model.spins()});
    for (int step = 1; step <= steps; ++step) {
      const bool settled = model.grains().step().settled;
      if (step % every == 0 || step == steps || settled) {
        writer.add(model.state(), stage, false,
                   {.velocities = model.velocities(), .spins = model.spins()});
      }
      if (settled) {
        break;
      }
    }
  }
  writer.flush();
}

}  // namespace clca::testing
