#include "cli/run_options.hpp"

#include <fmt/format.h>

#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/progress_line.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

std::string totals(const store::RunSummary& summary) {
  const std::string time =
      summary.units ? fmt::format(" (t = {})", summary.units->time_text(summary.steps)) : "";
  return fmt::format("{}: {} particles, {} steps{} in {:.3g} s, {:.3g} {}/s", summary.status,
                     summary.particles, summary.steps, time, summary.wall_seconds, summary.rate,
                     summary.kind == "boltzmann" ? "collisions" : "particle-updates");
}

int exit_code_of(const store::RunSummary& summary, int signal) {
  if (summary.status == "done") {
    return static_cast<int>(ExitCode::done);
  }
  return signal != 0 ? static_cast<int>(ExitCode::signal_base) + signal
                     : static_cast<int>(ExitCode::time_is_up);
}

}  // namespace

int threads_of(const RunCommonOptions& options, const scene::Scene& /*scene*/) {
  return options.threads.value_or(1);
}

int threads_of(const RunCommonOptions& options, const scene::BoltzmannScene& /*scene*/) {
  return options.threads.value_or(options.ranks != nullptr ? 1 : machine_threads());
}

int threads_here(const RunCommonOptions& options) {
  return threads_of(options, scene::BoltzmannScene()) *
         (options.ranks != nullptr ? options.ranks->on_this_machine() : 1);
}

void add_run_options(Command& command, RunCommonOptions& options) {
  command
      .option(
          "--threads", &options.threads,
          "Threads; the result does not depend on it. Of grains only the automaton takes more than "
          "one [1 for grains, all for a gas]")
      .values(whole_number(1, 1024));
  command
      .option(
          "--time-limit", &options.time_limit,
          "Save and stop after this time: 90 (seconds), 30min, 2h; clca resume continues the run")
      .type("TIME")
      .values(time_span());
  command
      .choice("--engine", &options.reference, {{"fast", false}, {"reference", true}},
              "fast, or reference: the rule as documented, one thread, slow; for checks")
      .type("NAME")
      .show_default("fast");
  const Option quiet = command.flag("--quiet", &options.quiet, "Print warnings and errors only");
  command
      .flag("--verbose", &options.verbose,
            "Print also what is done in between: stages that begin, checkpoints")
      .excludes(quiet);
  command.flag("--json", &options.json, "Print run.json at the end");
}

int serve_gases(const RunCommonOptions& options) {
  run::serve({.threads = threads_of(options, scene::BoltzmannScene()),
              .stop = &catch_stop_signals(),
              .ranks = options.ranks});
  return static_cast<int>(ExitCode::done);
}

void print_summary(const std::filesystem::path& folder) {
  constexpr double kMaxBytes = 1 << 30;
  const auto json = store::read_whole(folder / store::kSummaryFile, kMaxBytes);
  write_out({reinterpret_cast<const char*>(json.data()), json.size()});
}

int show_run(const std::string& folder, const RunCommonOptions& options, int threads,
             const RunIt& run_it) {
  ProgressLine line;
  run::RunEvents events;
  events.warning = [&](const std::string& text) { line.print("warning: " + text); };
  if (!options.quiet) {
    events.progress = [&](const run::Progress& progress) { line.show(progress); };
    events.gas_progress = [&](const run::GasProgress& progress) { line.show(progress); };
    events.message = [&](const std::string& text) { line.print(text); };
    if (options.verbose) {
      events.detail = events.message;
    }
  }
  std::filesystem::path used = folder;
  events.folder = [&](const std::filesystem::path& path) { used = path; };
  const std::atomic<int>& stop = catch_stop_signals();
  const store::RunSummary summary = run_it({.folder = folder,
                                            .threads = threads,
                                            .reference = options.reference,
                                            .stop = &stop,
                                            .time_limit = options.time_limit,
                                            .ranks = options.ranks},
                                           events);
  if (options.json) {
    print_summary(used);
  } else if (!options.quiet) {
    print_out("{}, state {:016x}\n{}\n", totals(summary), summary.state_hash, used.string());
  }
  if (summary.status == "interrupted" && !options.quiet) {
    line.print(fmt::format("continue with: clca resume {}", text::shell_word(used.string())));
  }
  return exit_code_of(summary, stop_signal_of(options.ranks));
}

}  // namespace clca::cli
