// clca run: runs a scene and leaves a run folder.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

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
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool quiet = false;
};

void print_totals(const store::RunSummary& summary, const std::string& folder) {
  fmt::print("{}: {} particles, {} steps in {:.3g} s, {:.3g} particle-updates/s, state {:016x}\n",
             summary.status, summary.particles, summary.steps, summary.wall_seconds,
             summary.particle_updates_per_second, summary.state_hash);
  fmt::print("{}\n", folder);
}

int run_scene(const RunCommandOptions& options) {
  const scene::Scene scene = load_scene(options.scene);
  const std::string folder = options.folder.empty() ? "renders/" + scene.name : options.folder;
  ProgressLine line;
  run::RunEvents events;
  events.warning = [&](const std::string& text) { line.print("warning: " + text); };
  if (!options.quiet) {
    events.progress = [&](const run::Progress& progress) { line.show(progress); };
    events.message = [&](const std::string& text) { line.print(text); };
  }
  const std::atomic<int>& stop = catch_stop_signals();
  const store::RunSummary summary =
      run::run(scene, {.folder = folder, .threads = options.threads, .stop = &stop}, events);
  if (!options.quiet) {
    print_totals(summary, folder);
  }
  return summary.status == "done" ? static_cast<int>(ExitCode::done)
                                  : static_cast<int>(ExitCode::signal_base) + stop;
}

}  // namespace

void add_run_command(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("run", "Run a scene: pictures, tables and numbers into a folder");
  auto options = std::make_shared<RunCommandOptions>();
  add_scene_options(*command, options->scene);
  command->add_option("-o,--output", options->folder, "Folder to write to [renders/SCENE-NAME]");
  command->add_option("--threads", options->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "Print warnings and errors only");
  command->callback([options, &code] { code = run_scene(*options); });
}

}  // namespace clca::cli
