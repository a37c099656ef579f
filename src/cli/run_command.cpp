// clca run, clca boltzmann: run a scene and leave a run folder.

#include <fmt/format.h>

#include <memory>
#include <variant>

#include "clca/run/run.hpp"
#include "cli/command.hpp"
#include "cli/run_options.hpp"
#include "cli/scene_options.hpp"

namespace clca::cli {

namespace {

struct RunCommandOptions {
  SceneOptions scene;
  std::string folder;
  bool keep = false;
  bool overwrite = false;
  RunCommonOptions run;
};

template <class Scene>
int run_one(const Scene& scene, const RunCommandOptions& options) {
  const std::string folder = options.folder.empty() ? "renders/" + scene.name : options.folder;
  if (!options.keep) {
    run::check_output(options.scene.file, folder);
  }
  const auto run_it = [&](run::RunOptions run, const run::RunEvents& events) {
    run.overwrite = options.overwrite;
    run.keep = options.keep;
    if (options.scene.frames_every == std::uint64_t{0}) {
      run.pictures = run::WantedPictures::none;
    }
    return run::run(scene, run, events);
  };
  return show_run(folder, options.run, threads_of(options.run, scene), run_it);
}

int run_scene(const RunCommandOptions& options) {
  const scene::AnyScene scene = load_any_scene(options.scene, threads_here(options.run));
  return std::visit([&](const auto& held) { return run_one(held, options); }, scene);
}

/// As run_scene(), for Boltzmann scenes only.
int run_boltzmann_scene(const RunCommandOptions& options) {
  if (options.run.ranks != nullptr && options.run.ranks->rank() > 0) {
    return serve_gases(options.run);
  }
  const scene::AnyScene scene = load_any_scene(options.scene, threads_here(options.run));
  if (const auto* automaton = std::get_if<scene::Scene>(&scene)) {
    throw scene::SceneError(fmt::format(
        "{}: error: a scene of grains, which clca run takes; clca boltzmann wants a block "
        "boltzmann in place of box to stages",
        automaton->box.location));
  }
  return run_one(std::get<scene::BoltzmannScene>(scene), options);
}

Command add_command(CommandLine& command_line, tasks::Ranks* ranks, const char* name,
                    const char* what, int (*run_it)(const RunCommandOptions&)) {
  Command command = command_line.command(name, what);
  auto options = std::make_shared<RunCommandOptions>();
  options->run.ranks = ranks;
  add_scene_options(command, options->scene);
  command.option("-o,--output", &options->folder, "Folder to write to [renders/SCENE-NAME]");
  const Option keep = command.flag(
      "--keep", &options->keep, "Leave an earlier run in the folder alone: write to FOLDER-2, ...");
  command
      .flag("--overwrite", &options->overwrite,
            "Replace an earlier run in the folder even if it could be resumed")
      .excludes(keep);
  add_run_options(command, options->run);
  command.action([options, run_it] { return run_it(*options); });
  return command;
}

}  // namespace

void add_run_command(CommandLine& command_line) {
  add_command(command_line, nullptr, "run",
              "Run a scene: pictures, tables and numbers into a folder", run_scene);
}

void add_boltzmann_command(CommandLine& command_line, tasks::Ranks* ranks) {
  Command command = add_command(command_line, ranks, "boltzmann",
                                "Run a scene of the Boltzmann equation", run_boltzmann_scene);
  command.remove_option("--frames-every");  // it draws no pictures
  command.remove_option("--begin");
}

}  // namespace clca::cli
