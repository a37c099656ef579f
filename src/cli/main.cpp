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
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/tasks/leader.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/ranks.hpp"
#include "cli/signals.hpp"
#include "cli/terminal.hpp"

namespace {

using clca::cli::ExitCode;

/// One line on standard error.
int fail(ExitCode code, std::string_view message) {
  clca::cli::print_error("{}\n", clca::text::printable(message));
  return static_cast<int>(code);
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
      "clca " + clca::run::version(),
      "Exit codes: 0 done; 1 a run or a figure failed, or pictures differ; 2 wrong input;\n"
      "124 (--time-limit), 129, 130 or 143 (SIGHUP, SIGINT, SIGTERM) interrupted; clca resume\n"
      "continues the run.");
  clca::cli::add_run_command(command_line);
  clca::cli::add_resume_command(command_line, ranks);
  clca::cli::add_boltzmann_command(command_line, ranks);
  clca::cli::add_sweep_command(command_line, ranks);
  clca::cli::add_check_command(command_line);
  clca::cli::add_compare_command(command_line);
  clca::cli::add_diff_command(command_line);
  clca::cli::add_explain_command(command_line);
  clca::cli::add_export_command(command_line);
  clca::cli::add_plot_command(command_line);
  clca::cli::add_render_command(command_line);
  clca::cli::add_report_command(command_line);
  command_line.command("help", "Print the help of a command: clca help run");
  return command_line.run(arguments_of(argc, argv));
}

int run_or_complain(int argc, char** argv, clca::tasks::Ranks* ranks) {
  try {
    return run_program(argc, argv, ranks);
  } catch (const clca::scene::SceneError& error) {
    return fail(ExitCode::wrong_input, error.what());
  } catch (const clca::text::InputError& error) {
    return fail(ExitCode::wrong_input, fmt::format("clca: error: {}", error.what()));
  } catch (const clca::run::SceneRunError& error) {
    return fail(ExitCode::wrong_input, error.what());
  } catch (const clca::process::StoppedError& error) {
    return fail(
        static_cast<ExitCode>(static_cast<int>(ExitCode::signal_base) + clca::cli::stop_signal()),
        fmt::format("clca: error: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failed, "clca: error: out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, fmt::format("clca: error: {}", error.what()));
  }
}

/// Of several ranks the first runs the program, and the others serve it.
int run_with_ranks(int argc, char** argv) {
  std::unique_ptr<clca::tasks::Ranks> ranks;
  try {
    ranks = clca::cli::started_ranks(argv);
  } catch (const clca::text::InputError& error) {
    if (*error.what() != '\0') {
      fail(ExitCode::wrong_input, fmt::format("clca: error: {}", error.what()));
    }
    return static_cast<int>(ExitCode::wrong_input);
  }
  if (!ranks || ranks->size() == 1) {
    return run_or_complain(argc, argv, nullptr);
  }
  if (ranks->rank() == 0) {
    const int code = run_or_complain(argc, argv, ranks.get());
    clca::tasks::dismiss(*ranks);
    return code;
  }
  clca::cli::be_silent();
  if (argc > 1 && clca::cli::is_shared(argv[1])) {
    const int code = run_or_complain(argc, argv, ranks.get());
    return code == static_cast<int>(ExitCode::failed) ? code : static_cast<int>(ExitCode::done);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) {
  clca::cli::occupy_closed_streams();
  clca::cli::set_up_signals();
  int code = static_cast<int>(ExitCode::failed);
  try {
    code = run_with_ranks(argc, argv);
  } catch (...) {  // no memory for a message either
    clca::cli::write_error("clca: error: out of memory\n");
  }
  return clca::cli::end_output(code);
}
