// clca run, clca boltzmann, clca resume: run a scene and leave a run folder, or go on with one.

#include <memory>
#include <type_traits>
#include <variant>

#include "clca/run/run.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/progress_line.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct RunCommandOptions {
  SceneOptions scene;
  run::RunOptions run;  ///< run_and_show() adds threads, reference, stop and pictures
  std::optional<std::string> until;
  std::optional<int> threads;
  std::string engine = "fast";
  bool quiet = false;
  bool verbose = false;
  bool json = false;

  bool is_other_rank() const { return run.ranks != nullptr && run.ranks->rank() > 0; }
};

/// Threads: as asked for, otherwise one for grains, since it depends on the machine whether
/// several are faster or slower; for a gas all of the machine, or one where ranks share it.
int threads_of(const RunCommandOptions& options, bool is_gas) {
  return options.threads.value_or(is_gas && options.run.ranks == nullptr ? machine_thread_count()
                                                                         : 1);
}

/// For a gas: those of all ranks on this machine, which share its memory.
int threads_here(const RunCommandOptions& options) {
  return threads_of(options, true) *
         (options.run.ranks != nullptr ? options.run.ranks->size_on_this_machine() : 1);
}

/// Advances gases for rank 0, as another rank. Returns the exit code.
int serve_gases(const RunCommandOptions& options) {
  run::work_for_rank_0({.threads = threads_of(options, true),
                        .stop_signal = &catch_stop_signals(),
                        .ranks = options.run.ranks});
  return kDone;
}

void print_summary(const std::filesystem::path& folder) {
  constexpr double kMaxBytes = 1 << 30;
  const auto json = store::read_whole_file(folder / store::kSummaryFile, kMaxBytes);
  write_out({reinterpret_cast<const char*>(json.data()), json.size()});
}

std::string totals(const store::RunSummary& summary) {
  const std::string time =
      summary.units ? fmt::format(" (t = {})", summary.units->time_text(summary.steps)) : "";
  return fmt::format("{}: {} particles, {} steps{} in {:.3g} s, {:.3g} {}/s", summary.status,
                     summary.particles, summary.steps, time, summary.wall_seconds,
                     summary.rate_per_second,
                     summary.kind == "boltzmann" ? "collisions" : "particle-updates");
}

/// Calls `run_it(run::RunOptions, run::RunEvents)`, shows progress and results. Returns the exit
/// code.
template <class RunIt>
int run_and_show(const RunCommandOptions& options, bool is_gas, RunIt run_it) {
  run::RunOptions wanted = options.run;
  wanted.threads = threads_of(options, is_gas);
  wanted.use_reference_step = options.engine != "fast";
  wanted.stop_signal = &catch_stop_signals();
  if (options.scene.frames_every == std::uint64_t{0}) {
    wanted.pictures = run::WantedPictures::none;
  }
  ProgressLine line;
  run::RunEvents events;
  events.warning = [&](const std::string& text) { line.print("warning: " + text); };
  if (!options.quiet) {
    const auto show = [&](const auto& progress) { line.show(to_text(progress)); };
    events.progress = show;
    events.gas_progress = show;
    events.message = [&](const std::string& text) { line.print(text); };
    if (options.verbose) {
      events.detail = events.message;
    }
  }
  std::filesystem::path used = wanted.folder;
  events.folder_known = [&](const std::filesystem::path& path) { used = path; };
  const store::RunSummary summary = run_it(wanted, events);
  if (options.json) {
    print_summary(used);
  } else if (!options.quiet) {
    print_out("{}, state {:016x}\n{}\n", totals(summary), summary.state_hash, used.string());
  }
  if (summary.status == "interrupted" && !options.quiet) {
    line.print(fmt::format("continue with: clca resume {}", text::shell_word(used.string())));
  }
  if (summary.status == "done") {
    return kDone;
  }
  const int signal = stop_signal_of(options.run.ranks);
  return signal != 0 ? kSignalBase + signal : kTimeIsUp;
}

template <class Scene>
int run_one(const Scene& scene, RunCommandOptions options) {
  if (options.run.folder.empty()) {
    options.run.folder = "renders/" + scene.name;
  }
  if (!options.run.keep_earlier_run) {
    run::check_output_folder(options.scene.file, options.run.folder);
  }
  constexpr bool kIsGas = std::is_same_v<Scene, scene::BoltzmannScene>;
  return run_and_show(options, kIsGas,
                      [&](const run::RunOptions& run, const run::RunEvents& events) {
                        return run::run(scene, run, events);
                      });
}

int run_scene(const RunCommandOptions& options) {
  const scene::AnyScene scene = load_any_scene(options.scene, threads_here(options));
  return std::visit([&](const auto& held) { return run_one(held, options); }, scene);
}

/// As run_scene(), for Boltzmann scenes only.
int run_boltzmann_scene(const RunCommandOptions& options) {
  if (options.is_other_rank()) {
    return serve_gases(options);
  }
  const scene::AnyScene scene = load_any_scene(options.scene, threads_here(options));
  if (const auto* automaton = std::get_if<scene::Scene>(&scene)) {
    throw scene::SceneError(fmt::format(
        "{}: error: a scene of grains, which clca run takes; clca boltzmann needs a block "
        "boltzmann in place of box to stages",
        automaton->box.location));
  }
  return run_one(std::get<scene::BoltzmannScene>(scene), options);
}

int resume_run(const RunCommandOptions& options) {
  if (options.is_other_rank()) {
    return serve_gases(options);  // or wait for rank 0, which goes on with grains alone
  }
  const double limit = memory_limit_bytes(options.scene);
  run::SavedRun saved =
      read_as_input([&] { return run::load_run(options.run.folder, limit, options.until); });
  if (saved.finished_summary) {
    if (options.json) {
      print_summary(options.run.folder);
    } else if (!options.quiet) {
      print_out("the run is done: there is nothing to resume\n{}\n", options.run.folder.string());
    }
    return kDone;
  }
  check_memory(saved.scene, limit, threads_here(options));
  const bool is_gas = std::holds_alternative<scene::BoltzmannScene>(saved.scene);
  return run_and_show(options, is_gas,
                      [&](const run::RunOptions& run, const run::RunEvents& events) {
                        return run::resume(std::move(saved), run, events);
                      });
}

void add_run_options(CLI::App* command, RunCommandOptions& options) {
  add_option(
      command, "--threads", options.threads, "",
      "Threads; the result does not depend on it. Of grains only the automaton takes more than "
      "one [1 for grains, all for a gas]",
      whole_number_validator(1, 1024));
  add_option(
      command, "--time-limit", options.run.wall_seconds_limit, "TIME",
      "Save and stop after this time: 90 (seconds), 30min, 2h; clca resume continues the run",
      duration_validator());
  add_option(command, "--engine", options.engine, "NAME",
             "fast, or reference: the rule as documented, one thread, slow; for checks",
             CLI::IsMember({"fast", "reference"}))
      ->capture_default_str();
  CLI::Option* quiet =
      command->add_flag("--quiet", options.quiet, "Print warnings and errors only");
  command
      ->add_flag("--verbose", options.verbose,
                 "Print also what is done in between: stages that begin, checkpoints")
      ->excludes(quiet);
  command->add_flag("--json", options.json, "Print run.json at the end");
}

CLI::App* add_command_with_scene(CLI::App& program, tasks::Ranks* ranks, const char* name,
                                 const char* what, int (*run_it)(const RunCommandOptions&)) {
  CLI::App* command = program.add_subcommand(name, what);
  auto options = std::make_shared<RunCommandOptions>();
  options->run.ranks = ranks;
  add_scene_options(command, options->scene);
  command->add_option("-o,--output", options->run.folder,
                      "Folder to write to [renders/SCENE-NAME]");
  CLI::Option* keep =
      command->add_flag("--keep", options->run.keep_earlier_run,
                        "Leave an earlier run in the folder alone: write to FOLDER-2, ...");
  command
      ->add_flag("--overwrite", options->run.replace_interrupted,
                 "Replace an earlier run in the folder even if it could be resumed")
      ->excludes(keep);
  add_run_options(command, *options);
  set_action(command, [options, run_it] { return run_it(*options); });
  return command;
}

void add_resume_command(CLI::App& program, tasks::Ranks* ranks) {
  CLI::App* command = program.add_subcommand(
      "resume", "Continue a run that was stopped or killed, or prolong one that is done");
  auto options = std::make_shared<RunCommandOptions>();
  options->run.ranks = ranks;
  command->add_option("DIR", options->run.folder, "Folder of the run")->required();
  add_option(command, "--until", options->until, "END",
             "Run to this end instead of the scene's: steps of the last stage, the time "
             "of a gas, or as `until` of a scene: settled, '{cycles: 400}'");
  add_run_options(command, *options);
  add_memory_limit_option(command, options->scene);
  set_action(command, [options] { return resume_run(*options); });
}

}  // namespace

void add_run_commands(CLI::App& program, tasks::Ranks* ranks) {
  add_command_with_scene(program, nullptr, "run",
                         "Run a scene: pictures, tables and numbers into a folder", run_scene);
  add_resume_command(program, ranks);
  CLI::App* boltzmann = add_command_with_scene(
      program, ranks, "boltzmann", "Run a scene of the Boltzmann equation", run_boltzmann_scene);
  for (const char* unused : {"--frames-every", "--begin"}) {  // it draws no pictures
    boltzmann->remove_option(boltzmann->get_option(unused));
  }
}

}  // namespace clca::cli
