// clca sweep: runs a scene for many seeds and values and leaves tables over all runs.
// clca calibrate: values of keys with which scenes give what was measured. The Python package says
// which sweeps are needed and what follows from them; they run here.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clca/process/program.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/sweep/sweep.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/package.hpp"
#include "cli/progress_line.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct SweepCommandOptions {
  SceneOptions scene;
  std::string seeds = "1..8";
  std::vector<std::string> variations;
  sweep::Options sweep;
  bool quiet = false;
};

/// Memory for this process, in bytes: ranks on one machine share its memory.
double memory_of_rank(const SweepCommandOptions& options) {
  const double limit = memory_limit_bytes(options.scene);
  const tasks::Ranks* ranks = options.sweep.ranks;
  const bool is_shared = ranks != nullptr && !options.scene.memory_limit;
  return is_shared ? limit / ranks->size_on_this_machine() : limit;
}

sweep::Plan plan_of(const SweepCommandOptions& options) {
  sweep::Request request = {.scene_file = options.scene.file,
                            .overrides = overrides_of(options.scene),
                            .variations = {},
                            .seeds = sweep::parse_seeds(options.seeds)};
  for (const std::string& text : options.variations) {
    request.variations.push_back(sweep::parse_variation(text));
  }
  return sweep::plan(std::move(request), memory_of_rank(options));
}

void print_totals(const sweep::Progress& totals, double seconds, const std::string& folder) {
  const std::size_t left =
      totals.total_runs - totals.done_runs - totals.failed_runs - totals.runs_elsewhere;
  const auto some = [](std::size_t count, const char* text) {
    return count > 0 ? fmt::format(fmt::runtime(text), count) : "";
  };
  print_out("{} runs: {} done{}, {} failed{}{}, in {:.3g} s\n{}\n", totals.total_runs,
            totals.done_runs, some(totals.reused_runs, " ({} from before)"), totals.failed_runs,
            some(totals.runs_elsewhere, ", {} under way elsewhere"),
            some(left, ", {} interrupted or not begun"), seconds, folder);
}

/// Tells on standard error what has failed or is missing.
int exit_code_of(const sweep::Progress& totals, tasks::Ranks* ranks) {
  const std::size_t missing = totals.total_runs - totals.done_runs - totals.failed_runs;
  if (const int signal = stop_signal_of(ranks); signal != 0 && missing > 0) {
    return kSignalBase + signal;
  }
  if (totals.failed_runs > 0) {
    print_error("clca: error: {} of {} runs failed\n", totals.failed_runs, totals.total_runs);
    return kFailed;
  }
  if (missing > 0) {
    const std::string elsewhere =
        totals.runs_elsewhere > 0
            ? fmt::format(
                  "; {} under way in other processes: call the same command again when "
                  "these have ended",
                  totals.runs_elsewhere)
            : "";
    print_error("clca: error: {} of {} runs are missing{}\n", missing, totals.total_runs,
                elsewhere);
    return kFailed;
  }
  return kDone;
}

sweep::Progress carry_out(const sweep::Plan& plan, const sweep::Options& wanted, int asked_jobs,
                          bool quiet) {
  ProgressLine line;
  sweep::Events events;
  events.warning = [&line](const std::string& text) { line.print("warning: " + text); };
  if (!quiet) {
    events.progress = [&line](const sweep::Progress& progress) { line.show(to_text(progress)); };
    events.message = [&line](const std::string& text) { line.print(text); };
  }
  if (wanted.jobs < asked_jobs && static_cast<std::size_t>(wanted.jobs) < plan.run_count()) {
    events.warning(fmt::format("{} runs at a time, as more do not fit into memory", wanted.jobs));
  }
  return sweep::execute(plan, wanted, events);
}

int run_sweep(const SweepCommandOptions& options) {
  const sweep::Plan plan = plan_of(options);
  sweep::Options wanted = options.sweep;
  if (wanted.folder.empty()) {
    wanted.folder = "renders/" + plan.variants.front().scene.name + "-sweep";
  }
  const double memory = memory_of_rank(options);
  wanted.jobs = sweep::fitting_jobs(plan, wanted.jobs, memory);
  wanted.max_bytes = memory / wanted.jobs;
  wanted.stop_signal = &catch_stop_signals();
  if (wanted.ranks != nullptr && wanted.ranks->rank() > 0) {
    sweep::work_for_rank_0(plan, wanted);
    return kDone;
  }
  const auto start = std::chrono::steady_clock::now();
  const sweep::Progress totals = carry_out(plan, wanted, options.sweep.jobs, options.quiet);
  if (!options.quiet) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_totals(totals, seconds.count(), wanted.folder.string());
  }
  return exit_code_of(totals, wanted.ranks);
}

/// The program and its arguments, by words.
std::vector<std::string> words_of(const std::string& command) {
  std::istringstream words(command);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The command, with `clca` behind the one that starts ranks.
std::vector<std::string> launch_command(const std::string& launcher) {
  std::vector<std::string> command = words_of(launcher);
  command.front() = process::find_program(command.front()).value().string();
  command.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
  return command;
}

/// As run_sweep(), by `command`. Throws process::ProcessError where it does not run the sweep.
int launch_sweep(std::vector<std::string> command, const std::string& launcher,
                 const SweepCommandOptions& options) {
  command.insert(
      command.end(),
      {"sweep", options.scene.file, "--vary", options.variations.front(), "--seeds", options.seeds,
       "--output", options.sweep.folder.string(), "--jobs", std::to_string(options.sweep.jobs)});
  for (const std::string& text : options.scene.overrides) {
    command.insert(command.end(), {"--set", text});
  }
  if (options.scene.memory_limit) {
    command.insert(command.end(), {"--memory-limit", std::to_string(*options.scene.memory_limit)});
  }
  if (options.quiet) {
    command.emplace_back("--quiet");
  }
  constexpr std::chrono::seconds kGrace(10);  // for runs to leave their checkpoints
  const std::atomic<int>& stop = catch_stop_signals();
  const int code =
      process::Program(command, {.stop = &stop, .stop_signal = SIGTERM, .grace_period = kGrace})
          .wait();
  if (stop != 0) {
    return kSignalBase + stop;
  }
  if (code != kDone) {
    throw process::ProcessError(fmt::format("'{}' ended with exit code {}", launcher, code));
  }
  if (!std::filesystem::exists(options.sweep.folder / "sweep.json")) {
    throw process::ProcessError(fmt::format("'{}' has not run the sweep", launcher));
  }
  return kDone;
}

/// One that Python asks for. Throws scene::SceneError with the place of the test in the study where
/// its scene does not take the ends of the ranges.
SweepCommandOptions sweep_of(const nlohmann::json& asked, SweepCommandOptions wanted) {
  wanted.scene.file = run::scene_file(asked.at("scene"));
  wanted.scene.overrides = asked.at("set");
  wanted.variations = {asked.at("ends")};
  try {
    plan_of(wanted);
  } catch (const scene::SceneError& error) {
    throw scene::SceneError(
        fmt::format("{}: error: {}", asked.at("place").get<std::string>(), error.what()));
  }
  wanted.variations = {asked.at("vary")};
  wanted.seeds = asked.at("seeds");
  wanted.sweep.folder = asked.at("folder").get<std::string>();
  return wanted;
}

int calibrate(const std::string& study_file, const std::string& launcher,
              const SweepCommandOptions& options) {
  std::filesystem::path path = options.sweep.folder;
  if (path.empty()) {
    path = "renders/" + std::filesystem::path(study_file).stem().string() + "-calibration";
  }
  const std::vector<std::string> command =
      launcher.empty() ? std::vector<std::string>() : launch_command(launcher);
  const store::OutputFolder folder(path);
  folder.require_clca_folder();
  for (int step = 0;; ++step) {
    auto sweeps = nlohmann::json::array();
    int code =
        run_python_command("calibrate", {{"step", step}, {"study", study_file}}, {path},
                           [&](const std::string& name, std::span<const std::uint8_t> bytes) {
                             if (name == "sweeps.json") {
                               sweeps = nlohmann::json::parse(bytes);
                             } else {
                               folder.write(name, bytes);
                             }
                           });
    if (code == kDone && sweeps.empty()) {
      print_out("{}\n", path.string());
    }
    if (code != kDone || sweeps.empty()) {
      return code;
    }
    std::vector<SweepCommandOptions> all;
    for (const nlohmann::json& asked : sweeps) {
      all.push_back(sweep_of(asked, options));
    }
    folder.make_clca_folder();
    for (const SweepCommandOptions& wanted : all) {
      code = launcher.empty() ? run_sweep(wanted) : launch_sweep(command, launcher, wanted);
      if (code != kDone) {
        return code;
      }
    }
  }
}

void add_jobs_option(CLI::App* command, sweep::Options& options, const std::string& what) {
  options.jobs = options.ranks != nullptr ? 1 : machine_thread_count();
  add_option(command, "--jobs", options.jobs, "", what, whole_number_validator(1, 1024))
      ->capture_default_str();
}

}  // namespace

void add_sweep_command(CLI::App& program, tasks::Ranks* ranks) {
  CLI::App* command = program.add_subcommand(
      "sweep", "Run a scene for many seeds and values: tables and an overview into a folder");
  auto options = std::make_shared<SweepCommandOptions>();
  options->sweep.ranks = ranks;
  add_scene_set_begin_options(command, options->scene);
  add_option(
      command, "--seeds", options->seeds, "SEEDS",
      "Seeds of the random draws, such as 1..16 or 1,4,9..12; each value runs with each seed")
      ->capture_default_str();
  add_option(command, "--vary", options->variations, "KEY=V1,V2,...",
             "Run with KEY set to each of these values (YAML), such as rules.inertia=0,0.9 "
             "or a range FIRST:LAST:STEP; K1,K2=V1,V2; W1,W2 varies keys together; repeated: "
             "all combinations",
             assignment_validator("KEY=V1,V2,..."))
      ->allow_extra_args(false);
  command->add_option("-o,--output", options->sweep.folder,
                      "Folder to write to, and to continue in [renders/SCENE-NAME-sweep]");
  add_jobs_option(command, options->sweep,
                  "Runs at a time, each with one thread; with mpirun on each rank; the result does "
                  "not depend on it");
  const auto set_part = [part = &options->sweep.part](const std::string& text) {
    const std::size_t slash = text.find('/');
    *part = {.number = std::stoul(text.substr(0, slash)),
             .count = std::stoul(text.substr(slash + 1))};
  };
  CLI::Option* part =
      command
          ->add_option_function<std::string>(
              "--part", set_part,
              "Do part K of N of the runs only, without tables; the same command without --part "
              "collects them and does what is missing")
          ->type_name("K/N")
          ->transform(part_validator(100'000));
  command
      ->add_flag("--collect", options->sweep.collect_only,
                 "Run nothing: tables over the runs that are there, and how many are missing")
      ->excludes(part);
  command->add_flag("--frames", options->sweep.all_pictures,
                    "All pictures that the scene asks for, not only the last of each run that the "
                    "overview shows");
  add_memory_limit_option(command, options->scene);
  command->add_flag("--quiet", options->quiet, "Print warnings and errors only");
  set_action(command, [options] { return run_sweep(*options); });
}

void add_calibrate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "calibrate", "Find values of keys with which scenes give what was measured");
  auto options = std::make_shared<SweepCommandOptions>();
  auto study_file = std::make_shared<std::string>();
  command
      ->add_option(
          "STUDY", *study_file,
          "File (YAML) with the tests, each a scene with its targets, and the keys to vary")
      ->required();
  command->add_option("-o,--output", options->sweep.folder,
                      "Folder to write to, and to continue in [renders/STUDY-NAME-calibration]");
  add_jobs_option(
      command, options->sweep,
      "Runs at a time, each with one thread; with --launcher on each rank, 1 if left out; the "
      "result does not depend on it");
  auto launcher = std::make_shared<std::string>();
  add_option(command, "--launcher", *launcher, "COMMAND",
             "Run the sweeps by this command, which starts several ranks, such as 'mpirun -n "
             "64'")
      ->check([](const std::string& text) {
        const std::vector<std::string> words = words_of(text);
        return !words.empty() && process::find_program(words.front())
                   ? std::string()
                   : fmt::format("no program '{}' on the PATH", words.empty() ? "" : words.front());
      });
  add_memory_limit_option(command, options->scene, "Memory of all runs at a time");
  command->add_flag("--quiet", options->quiet, "Print the answer, warnings and errors only");
  set_action(command, [command, options, study_file, launcher] {
    if (!launcher->empty() && command->count("--jobs") == 0) {
      options->sweep.jobs = 1;
    }
    return calibrate(*study_file, *launcher, *options);
  });
}

}  // namespace clca::cli
