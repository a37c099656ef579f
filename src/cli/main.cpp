// clca: the list of commands. One command, one file.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "clca/process/program.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/tasks/leader.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
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

/// CLI11 would only say that a subcommand is required.
void check_command_name(const CLI::App& app, const std::vector<const char*>& arguments) {
  if (arguments.size() < 2 || *arguments[1] == '-' || *arguments[1] == '\0') {
    return;
  }
  const std::string_view given = arguments[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  if (std::find(names.begin(), names.end(), given) == names.end()) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw CLI::ParseError(fmt::format("no command {}{}", clca::text::shown(given),
                                      clca::text::suggestion(given, known)),
                          CLI::ExitCodes::InvalidError);
  }
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
  CLI::App app(
      "Granular flow on a triangular lattice, by the Connected Lattice Cellular Automaton or by\n"
      "contact dynamics, and the Boltzmann equation of inelastic, frictional spheres.",
      "clca");
  app.set_version_flag("-V,--version", "clca " + clca::run::version());
  app.require_subcommand(1);
  app.failure_message([](const CLI::App* /*app*/, const CLI::Error& error) {
    return fmt::format("clca: error: {} (see clca --help)\n", clca::text::printable(error.what()));
  });
  app.footer(
      "Exit codes: 0 done; 1 a run or a figure failed, or pictures differ; 2 wrong input;\n"
      "124 (--time-limit), 129, 130 or 143 (SIGHUP, SIGINT, SIGTERM) interrupted; clca resume\n"
      "continues the run.");

  int code = 0;
  clca::cli::add_run_command(app, code);
  clca::cli::add_resume_command(app, code, ranks);
  clca::cli::add_boltzmann_command(app, code, ranks);
  clca::cli::add_sweep_command(app, code, ranks);
  clca::cli::add_check_command(app, code);
  clca::cli::add_compare_command(app);
  clca::cli::add_diff_command(app, code);
  clca::cli::add_explain_command(app);
  clca::cli::add_export_command(app, code);
  clca::cli::add_plot_command(app);
  clca::cli::add_render_command(app, code);
  clca::cli::add_report_command(app);
  app.add_subcommand("help", "Print the help of a command: clca help run");
  const std::vector<const char*> arguments = arguments_of(argc, argv);
  try {
    check_command_name(app, arguments);
    if (std::any_of(arguments.begin(), arguments.end(),
                    [](const char* text) { return *text == '\0'; })) {
      throw CLI::ParseError("an argument is empty", CLI::ExitCodes::InvalidError);
    }
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream err;
    const bool is_help = app.exit(error, out, err) == 0;
    clca::cli::write_out(out.str());
    clca::cli::write_error(err.str());
    return static_cast<int>(is_help ? ExitCode::done : ExitCode::wrong_input);
  }
  return code;
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
