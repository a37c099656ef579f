// clca resume: continues a run from its last checkpoint.

#include <memory>
#include <variant>

#include "cli/command.hpp"
#include "cli/input.hpp"
#include "cli/run_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ResumeOptions {
  std::string folder;
  std::optional<std::string> until;
  SceneOptions scene;
  RunCommonOptions run;
};

int resume_run(const ResumeOptions& options) {
  if (options.run.ranks != nullptr && options.run.ranks->rank() > 0) {
    return serve_gases(options.run);  // or wait for rank 0, which goes on with grains alone
  }
  const double limit = memory_limit(options.scene);
  run::SavedRun saved =
      as_input([&] { return run::load_run(options.folder, limit, options.until); });
  if (saved.finished) {
    if (options.run.json) {
      print_summary(options.folder);
    } else if (!options.run.quiet) {
      print_out("the run is done: there is nothing to resume\n{}\n", options.folder);
    }
    return static_cast<int>(ExitCode::done);
  }
  check_memory(saved.scene, limit, threads_here(options.run));
  const int threads =
      std::visit([&](const auto& scene) { return threads_of(options.run, scene); }, saved.scene);
  return show_run(options.folder, options.run, threads,
                  [&](const run::RunOptions& run, const run::RunEvents& events) {
                    return run::resume(std::move(saved), run, events);
                  });
}

}  // namespace

void add_resume_command(CommandLine& command_line, tasks::Ranks* ranks) {
  Command command = command_line.command(
      "resume", "Continue a run that was stopped or killed, or prolong one that is done");
  auto options = std::make_shared<ResumeOptions>();
  options->run.ranks = ranks;
  command.option("DIR", &options->folder, "Folder of the run").required();
  command
      .option("--until", &options->until,
              "Run to this end instead of the scene's: steps of the last stage, the time "
              "of a gas, or as `until` of a scene: settled, '{cycles: 400}'")
      .type("END");
  add_run_options(command, options->run);
  add_memory_limit(command, options->scene);
  command.action([options] { return resume_run(*options); });
}

}  // namespace clca::cli
