// clca run, clca boltzmann: run a scene and leave a run folder.

#include <fmt/format.h>

#include <memory>
#include <variant>

#include "clca/run/run.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/progress_line.hpp"
#include "cli/scene_options.hpp"
#include "cli/signals.hpp"

namespace clca::cli {

namespace {

struct RunCommandOptions {
  SceneOptions scene;
  std::string folder;
  int threads = machine_threads();
  bool quiet = false;
};

std::string totals(const store::RunSummary& summary) {
  if (summary.kind == "boltzmann") {
    return fmt::format("{}: {} particles, {} steps in {:.3g} s, {:.3g} collisions/s",
                       summary.status, summary.particles, summary.steps, summary.wall_seconds,
                       summary.rate);
  }
  return fmt::format("{}: {} particles, {} steps in {:.3g} s, {:.3g} particle-updates/s",
                     summary.status, summary.particles, summary.steps, summary.wall_seconds,
                     summary.rate);
}

template <class Scene>
int run_one(const Scene& scene, const RunCommandOptions& options) {
  const std::string folder = options.folder.empty() ? "renders/" + scene.name : options.folder;
  ProgressLine line;
  run::RunEvents events;
  events.warning = [&](const std::string& text) { line.print("warning: " + text); };
  if (!options.quiet) {
    events.progress = [&](const run::Progress& progress) { line.show(progress); };
    events.gas_progress = [&](const run::GasProgress& progress) { line.show(progress); };
    events.message = [&](const std::string& text) { line.print(text); };
  }
  const std::atomic<int>& stop = catch_stop_signals();
  const store::RunSummary summary =
      run::run(scene, {.folder = folder, .threads = options.threads, .stop = &stop}, events);
  if (!options.quiet) {
    fmt::print("{}, state {:016x}\n{}\n", totals(summary), summary.state_hash, folder);
  }
  return summary.status == "done" ? static_cast<int>(ExitCode::done)
                                  : static_cast<int>(ExitCode::signal_base) + stop;
}

int run_scene(const RunCommandOptions& options) {
  const scene::AnyScene scene = load_any_scene(options.scene, options.threads);
  return std::visit([&](const auto& one) { return run_one(one, options); }, scene);
}

/// As run_scene(), for scenes of the Boltzmann equation alone.
int run_boltzmann_scene(const RunCommandOptions& options) {
  const scene::AnyScene scene = load_any_scene(options.scene, options.threads);
  if (const auto* automaton = std::get_if<scene::Scene>(&scene)) {
    throw scene::SceneError(fmt::format(
        "{}: error: a scene of the automaton, which clca run takes; clca boltzmann wants a block "
        "boltzmann in place of box to stages",
        automaton->box.place));
  }
  return run_one(std::get<scene::BoltzmannScene>(scene), options);
}

CLI::App* add_command(CLI::App& app, int& code, const char* name, const char* what,
                      int (*run_it)(const RunCommandOptions&)) {
  CLI::App* command = app.add_subcommand(name, what);
  auto options = std::make_shared<RunCommandOptions>();
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->folder, "Folder to write to [renders/SCENE-NAME]");
  command->add_option("--threads", options->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "Print warnings and errors only");
  command->callback([options, &code, run_it] { code = run_it(*options); });
  return command;
}

}  // namespace

void add_run_command(CLI::App& app, int& code) {
  add_command(app, code, "run", "Run a scene: pictures, tables and numbers into a folder",
              run_scene);
}

void add_boltzmann_command(CLI::App& app, int& code) {
  CLI::App* command = add_command(app, code, "boltzmann", "Run a scene of the Boltzmann equation",
                                  run_boltzmann_scene);
  command->remove_option(command->get_option("--frames-every"));  // it draws no pictures
}

}  // namespace clca::cli
