// clca sweep: runs a scene for many seeds and values and leaves tables over all runs.

#include "cli/sweep_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/progress_line.hpp"
#include "cli/ranks.hpp"
#include "cli/scene_options.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

/// Of this process, in bytes: ranks on one machine share its memory.
double memory_of_rank(const SweepCommandOptions& options) {
  const double limit = memory_limit(options.scene);
  const bool is_shared = options.ranks != nullptr && !options.scene.memory_limit;
  return is_shared ? limit / options.ranks->on_this_machine() : limit;
}

sweep::Plan plan_of(const SweepCommandOptions& options) {
  sweep::Request request = {.scene = options.scene.file,
                            .overrides = overrides_of(options.scene),
                            .variations = {},
                            .seeds = sweep::parse_seeds(options.seeds)};
  for (const std::string& text : options.variations) {
    request.variations.push_back(sweep::parse_variation(text));
  }
  return sweep::plan(std::move(request), memory_of_rank(options));
}

/// Number of parallel runs: as requested and as fit into memory.
int fitting_jobs(const sweep::Plan& plan, const SweepCommandOptions& options) {
  return sweep::fitting_jobs(plan, options.jobs, memory_of_rank(options));
}

void print_totals(const sweep::Progress& totals, double seconds, const std::string& folder) {
  const std::string reused =
      totals.reused > 0 ? fmt::format(" ({} from before)", totals.reused) : "";
  const std::size_t missing = totals.runs - totals.done - totals.failed;
  const std::size_t left = missing - totals.elsewhere;
  const std::string interrupted =
      (totals.elsewhere > 0 ? fmt::format(", {} under way elsewhere", totals.elsewhere) : "") +
      (left > 0 ? fmt::format(", {} interrupted or not begun", left) : "");
  print_out("{} runs: {} done{}, {} failed{}, in {:.3g} s\n", totals.runs, totals.done, reused,
            totals.failed, interrupted, seconds);
  print_out("{}\n", folder);
}

sweep::Events events_to(ProgressLine& line, bool quiet) {
  sweep::Events events;
  events.warning = [&line](const std::string& text) { line.print("warning: " + text); };
  if (!quiet) {
    events.progress = [&line](const sweep::Progress& progress) { line.show(progress); };
    events.message = [&line](const std::string& text) { line.print(text); };
  }
  return events;
}

std::string folder_of(const sweep::Plan& plan, const SweepCommandOptions& options) {
  return options.folder.empty() ? "renders/" + plan.variants.front().scene.name + "-sweep"
                                : options.folder;
}

sweep::Options sweep_options(const SweepCommandOptions& options, const std::string& folder,
                             int jobs, const std::atomic<int>& stop) {
  return {.folder = folder,
          .part = options.part,
          .collect_only = options.collect_only,
          .jobs = jobs,
          .all_pictures = options.all_pictures,
          .max_bytes = memory_of_rank(options) / jobs,
          .ranks = options.ranks,
          .stop = &stop};
}

sweep::Progress carry_out(const sweep::Plan& plan, const SweepCommandOptions& options,
                          const std::string& folder, const std::atomic<int>& stop) {
  ProgressLine line;
  const sweep::Events events = events_to(line, options.quiet);
  const int jobs = fitting_jobs(plan, options);
  if (jobs < options.jobs && static_cast<std::size_t>(jobs) < plan.run_count()) {
    events.warning(fmt::format("{} runs at a time, as more do not fit into memory", jobs));
  }
  return sweep::execute(plan, sweep_options(options, folder, jobs, stop), events);
}

}  // namespace

int run_sweep(const SweepCommandOptions& options) {
  const sweep::Plan plan = plan_of(options);
  const std::string folder = folder_of(plan, options);
  const std::atomic<int>& stop = catch_stop_signals();
  if (options.ranks != nullptr && options.ranks->rank() > 0) {
    sweep::serve(plan, sweep_options(options, folder, fitting_jobs(plan, options), stop));
    return static_cast<int>(ExitCode::done);
  }
  const auto start = std::chrono::steady_clock::now();
  const sweep::Progress totals = carry_out(plan, options, folder, stop);
  if (!options.quiet) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_totals(totals, seconds.count(), folder);
  }
  if (const int signal = stop_signal_of(options.ranks);
      signal != 0 && totals.done + totals.failed < totals.runs) {
    return static_cast<int>(ExitCode::signal_base) + signal;
  }
  if (totals.failed > 0) {
    print_error("clca: error: {} of {} runs failed\n", totals.failed, totals.runs);
    return static_cast<int>(ExitCode::failed);
  }
  if (totals.done < totals.runs) {
    const std::string elsewhere =
        totals.elsewhere > 0
            ? fmt::format(
                  "; {} under way in other processes: call the same command again when "
                  "these have ended",
                  totals.elsewhere)
            : "";
    print_error("clca: error: {} of {} runs are missing{}\n", totals.runs - totals.done,
                totals.runs, elsewhere);
    return static_cast<int>(ExitCode::failed);
  }
  return static_cast<int>(ExitCode::done);
}

void add_sweep_command(CommandLine& command_line, tasks::Ranks* ranks) {
  Command command = command_line.command(
      "sweep", "Run a scene for many seeds and values: tables and an overview into a folder");
  auto options = std::make_shared<SweepCommandOptions>();
  if (ranks != nullptr) {
    options->ranks = ranks;
    options->jobs = 1;
  }
  add_scene_and_set(command, options->scene);
  command
      .option(
          "--seeds", &options->seeds,
          "Seeds of the random draws, such as 1..16 or 1,4,9..12; each value runs with each seed")
      .type("SEEDS")
      .show_default();
  command
      .option("--vary", &options->variations,
              "Run with KEY set to each of these values (YAML), such as rules.inertia=0,0.9 "
              "or a range FIRST:LAST:STEP; K1,K2=V1,V2; W1,W2 varies keys together; repeated: "
              "all combinations")
      .type("KEY=V1,V2,...")
      .values(assignment("KEY=V1,V2,..."))
      .one_value();
  command.option("-o,--output", &options->folder,
                 "Folder to write to, and to continue in [renders/SCENE-NAME-sweep]");
  command
      .option("--jobs", &options->jobs,
              "Runs at a time, each with one thread; with mpirun on each rank; the result does "
              "not depend on it")
      .values(whole_number(1, 1024))
      .show_default();
  Option part = command.option(
      "--part",
      [part = &options->part](const std::string& text) {
        const std::size_t slash = text.find('/');
        *part = {.number = std::stoul(text.substr(0, slash)),
                 .of = std::stoul(text.substr(slash + 1))};
      },
      "Do part K of N of the runs only, without tables; the same command without --part "
      "collects them and does what is missing");
  part.type("K/N").values(part_of_whole(100'000));
  command
      .flag("--collect", &options->collect_only,
            "Run nothing: tables over the runs that are there, and how many are missing")
      .excludes(part);
  command.flag("--frames", &options->all_pictures,
               "All pictures that the scene asks for, not only the last of each run that the "
               "overview shows");
  add_memory_limit(command, options->scene);
  command.flag("--quiet", &options->quiet, "Print warnings and errors only");
  command.action([options] { return run_sweep(*options); });
}

}  // namespace clca::cli
