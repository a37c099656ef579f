// clca: the list of commands. One command, one file.

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "clca/process/program.hpp"
#include "clca/record/provenance.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace {

using clca::cli::ExitCode;

/// How the program ends: its exit code and, if it has failed, a line about it.
struct Ending {
  int code = 0;
  std::string line = {};
};

Ending failure(ExitCode code, std::string_view message) {
  return {static_cast<int>(code), clca::text::printable(message)};
}

int tell(const Ending& ending) {
  if (!ending.line.empty()) {
    clca::cli::print_error("{}\n", ending.line);
  }
  return ending.code;
}

/// `clca help COMMAND` is `clca COMMAND --help`.
std::vector<const char*> arguments_of(int argc, char** argv) {
  std::vector<const char*> arguments(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    arguments.erase(arguments.begin() + 1);
    arguments.insert(arguments.begin() + std::min<std::ptrdiff_t>(argc - 1, 2), "--help");
  }
  return arguments;
}

int run_program(int argc, char** argv, clca::tasks::Ranks* ranks) {
  clca::cli::CommandLine command_line(
      "Granular flow on a triangular lattice, by the Connected Lattice Cellular Automaton or by\n"
      "contact dynamics, and the Boltzmann equation of inelastic, frictional spheres.",
      "clca " + clca::record::version(),
      "Exit codes: 0 done; 1 a run or a figure failed, or pictures differ; 2 wrong input;\n"
      "124 (--time-limit), 129, 130 or 143 (SIGHUP, SIGINT, SIGTERM) interrupted; clca resume\n"
      "continues the run.");
  clca::cli::add_run_command(command_line);
  clca::cli::add_resume_command(command_line, ranks);
  clca::cli::add_boltzmann_command(command_line, ranks);
  clca::cli::add_sweep_command(command_line, ranks);
  clca::cli::add_calibrate_command(command_line);
  clca::cli::add_check_command(command_line);
  clca::cli::add_compare_command(command_line);
  clca::cli::add_diff_command(command_line);
  clca::cli::add_explain_command(command_line);
  clca::cli::add_export_command(command_line);
  clca::cli::add_plot_command(command_line);
  clca::cli::add_render_command(command_line);
  clca::cli::add_report_command(command_line);
  clca::cli::add_scenes_command(command_line);
  command_line.command("help", "Print the help of a command: clca help run");
  const std::string_view name = argc > 1 ? argv[1] : "";
  if (name == "__complete") {
    clca::cli::write_out(command_line.completions({argv + 2, argv + argc}));
    return static_cast<int>(ExitCode::done);
  }
  if (name == "__man" && argc == 3) {
    for (const auto& [file, text] : command_line.man_pages()) {
      clca::store::write_whole(std::filesystem::path(argv[2]) / file, {text.begin(), text.end()});
    }
    return static_cast<int>(ExitCode::done);
  }
  return command_line.run(arguments_of(argc, argv));
}

Ending ending_of(int argc, char** argv, clca::tasks::Ranks* ranks) {
  try {
    return {run_program(argc, argv, ranks)};
  } catch (const clca::scene::SceneError& error) {
    return failure(ExitCode::wrong_input, error.what());
  } catch (const clca::tasks::StartError& error) {
    return failure(ExitCode::wrong_input, error.what());
  } catch (const clca::text::InputError& error) {
    return failure(ExitCode::wrong_input, fmt::format("clca: error: {}", error.what()));
  } catch (const clca::process::StoppedError& error) {
    return failure(
        static_cast<ExitCode>(static_cast<int>(ExitCode::signal_base) + clca::cli::stop_signal()),
        fmt::format("clca: error: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return failure(ExitCode::failed, "clca: error: out of memory");
  } catch (const std::exception& error) {
    return failure(ExitCode::failed, fmt::format("clca: error: {}", error.what()));
  }
}

/// As one of several ranks. Rank 0 tells what all begin with; a rank that fails while they work
/// tells that itself and ends all.
int run_as_rank(int argc, char** argv, clca::tasks::Ranks& ranks) {
  const bool is_first = ranks.rank() == 0;
  if (!is_first) {
    clca::cli::be_silent();
  }
  if (argc < 2 || !clca::cli::is_shared(argv[1])) {
    return is_first ? tell(ending_of(argc, argv, nullptr)) : static_cast<int>(ExitCode::done);
  }
  const Ending ending = ending_of(argc, argv, &ranks);
  if (ranks.is_at_work() && !ending.line.empty()) {
    clca::cli::write_always(is_first ? ending.line + "\n"
                                     : fmt::format("rank {}: {}\n", ranks.rank(), ending.line));
    clca::cli::end_all_ranks(ending.code);
  }
  tell(ending);
  if (!ranks.has_begun()) {
    ranks.begin("", ending.line.empty() ? "nothing to do together" : ending.line);
  } else if (ranks.is_at_work() && is_first) {
    ranks.dismiss();
  }
  return is_first ? ending.code : static_cast<int>(ExitCode::done);
}

int run(int argc, char** argv, std::unique_ptr<clca::tasks::Ranks>& ranks) {
  try {
    ranks = clca::cli::started_ranks(argv);
  } catch (const clca::text::InputError& error) {
    const bool is_told = *error.what() == '\0';  // by another process
    return is_told
               ? static_cast<int>(ExitCode::wrong_input)
               : tell(failure(ExitCode::wrong_input, fmt::format("clca: error: {}", error.what())));
  }
  return ranks && ranks->size() > 1 ? run_as_rank(argc, argv, *ranks)
                                    : tell(ending_of(argc, argv, nullptr));
}

}  // namespace

int main(int argc, char** argv) {
  clca::cli::occupy_closed_streams();
  clca::cli::set_up_signals();
  clca::store::end_without_hdf5();
  int code = static_cast<int>(ExitCode::failed);
  std::unique_ptr<clca::tasks::Ranks> ranks;
  try {
    code = run(argc, argv, ranks);
  } catch (...) {  // no memory for a message either
    clca::cli::write_always("clca: error: out of memory\n");
    if (ranks) {
      clca::cli::end_all_ranks(code);
    }
  }
  ranks.reset();
  return clca::cli::end_output(code);
}
