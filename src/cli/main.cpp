// clca: the list of commands.

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string_view>

#include "clca/process/program.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/trajectory.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "cli/command.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

/// How the program ends: its exit code and, if it has failed, a line about it.
struct ProgramEnd {
  int code = 0;
  std::string line = {};
};

ProgramEnd failure(int code, std::string_view message) {
  return {code, text::printable(fmt::format("clca: error: {}", message))};
}

int report_end(const ProgramEnd& ending) {
  if (!ending.line.empty()) {
    print_error("{}\n", ending.line);
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

constexpr std::size_t kShownCharacters = 400;  // of a message, which may hold a long argument

/// CLI11 would only say that a subcommand is required.
void check_command_name(const CLI::App& program, std::string_view given) {
  if (given.empty() || given.front() == '-') {
    return;
  }
  std::vector<std::string_view> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  if (std::ranges::find(names, given) == names.end()) {
    throw CLI::ParseError(
        fmt::format("no command {}{}", text::quoted(given), text::suggestion(given, names)),
        CLI::ExitCodes::InvalidError);
  }
}

/// Throws for the first argument that has not been taken; CLI11 names all, the last one first.
void refuse_unknown(const CLI::App& program) {
  const std::vector<std::string> unknown = program.remaining(true);
  if (unknown.empty() || std::ranges::count(unknown, "--") > 0) {
    return;
  }
  const auto commands = program.get_subcommands();
  const CLI::App& command = commands.empty() ? program : *commands.front();
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      options.push_back("--" + name);
    }
  }
  const std::string given = unknown.front().substr(0, unknown.front().find('='));
  const std::vector<std::string_view> names(options.begin(), options.end());
  throw CLI::ParseError(
      fmt::format("{} was not expected{}", text::quoted(given), text::suggestion(given, names)),
      CLI::ExitCodes::ExtrasError);
}

void parse(CLI::App& program, const std::vector<const char*>& arguments) {
  check_command_name(program, arguments.size() > 1 ? arguments[1] : "");
  if (std::ranges::any_of(arguments, [](const char* text) { return *text == '\0'; })) {
    throw CLI::ParseError("an argument is empty", CLI::ExitCodes::InvalidError);
  }
  try {
    program.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::ExtrasError&) {
    refuse_unknown(program);
    throw;
  } catch (const CLI::RequiredError&) {
    // CLI11 asks for a command first, even if it has seen an option that it does not know.
    if (program.get_subcommands().empty()) {
      refuse_unknown(program);
    }
    throw;
  }
}

/// Runs the command that the arguments name, or prints help; the first argument is the program.
/// Returns the exit code. Throws text::InputError.
int carry_out(CLI::App& program, const std::vector<const char*>& arguments) {
  try {
    parse(program, arguments);
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      throw text::InputError(
          fmt::format("{} (see clca --help)", text::shortened(error.what(), kShownCharacters)));
    }
    std::ostringstream text;
    program.exit(error, text, text);
    write_out(text.str());
  }
  return kDone;
}

int run_program(int argc, char** argv, tasks::Ranks* ranks) {
  CLI::App program(
      "Granular flow on a triangular lattice, by the Connected Lattice Cellular Automaton or by\n"
      "contact dynamics, and the Boltzmann equation of inelastic, frictional spheres.",
      "clca");
  program.set_version_flag("-V,--version", "clca " + store::version());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 a run or a figure failed, or pictures differ; 2 wrong input;\n"
      "124 (--time-limit), 129, 130 or 143 (SIGHUP, SIGINT, SIGTERM) interrupted; clca resume\n"
      "continues the run.");
  add_run_commands(program, ranks);
  add_sweep_command(program, ranks);
  add_calibrate_command(program);
  add_check_command(program);
  add_compare_command(program);
  add_diff_command(program);
  add_explain_command(program);
  add_export_command(program);
  add_plot_command(program);
  add_render_command(program);
  add_report_command(program);
  add_scenes_command(program);
  program.add_subcommand("help", "Print the help of a command: clca help run");
  const std::string_view name = argc > 1 ? argv[1] : "";
  if (name == "__complete") {
    write_out(completions(program, {argv + 2, argv + argc}));
    return kDone;
  }
  if (name == "__man" && argc == 3) {
    for (const auto& [file, text] : man_pages(program)) {
      store::write_whole_file(std::filesystem::path(argv[2]) / file, {text.begin(), text.end()});
    }
    return kDone;
  }
  return carry_out(program, arguments_of(argc, argv));
}

ProgramEnd run_and_catch(int argc, char** argv, tasks::Ranks* ranks) {
  try {
    return {run_program(argc, argv, ranks)};
  } catch (const scene::SceneError& error) {
    return {kWrongInput, text::printable(error.what())};
  } catch (const tasks::StartError& error) {
    return {kWrongInput, text::printable(error.what())};
  } catch (const text::InputError& error) {
    return failure(kWrongInput, error.what());
  } catch (const process::StoppedError& error) {
    return failure(kSignalBase + stop_signal(), error.what());
  } catch (const std::bad_alloc&) {
    return failure(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return failure(kFailed, error.what());
  }
}

/// As one of several ranks. Rank 0 tells what all begin with; a rank that fails while they work
/// tells that itself and ends all.
int run_as_rank(int argc, char** argv, tasks::Ranks& ranks) {
  const bool is_first = ranks.rank() == 0;
  if (!is_first) {
    silence_output();
  }
  if (argc < 2 || !can_use_ranks(argv[1])) {
    return is_first ? report_end(run_and_catch(argc, argv, nullptr)) : kDone;
  }
  const ProgramEnd ending = run_and_catch(argc, argv, &ranks);
  if (ranks.is_at_work() && !ending.line.empty()) {
    write_always(is_first ? ending.line + "\n"
                          : fmt::format("rank {}: {}\n", ranks.rank(), ending.line));
    end_all_ranks(ending.code);
  }
  report_end(ending);
  if (!ranks.has_begun()) {
    ranks.begin("", ending.line.empty() ? "nothing to do together" : ending.line);
  } else if (ranks.is_at_work() && is_first) {
    ranks.dismiss();
  }
  return is_first ? ending.code : kDone;
}

/// Returns the exit code. `ranks`: that have been started, until the end.
int run_main(int argc, char** argv, std::unique_ptr<tasks::Ranks>& ranks) {
  try {
    ranks = start_ranks(argv);
  } catch (const text::InputError& error) {
    const bool is_told = *error.what() == '\0';  // by another process
    return is_told ? kWrongInput : report_end(failure(kWrongInput, error.what()));
  }
  return ranks && ranks->size() > 1 ? run_as_rank(argc, argv, *ranks)
                                    : report_end(run_and_catch(argc, argv, nullptr));
}

}  // namespace

}  // namespace clca::cli

int main(int argc, char** argv) {
  clca::cli::occupy_closed_streams();
  clca::cli::set_up_signals();
  clca::store::disable_hdf5_exit();
  int code = clca::cli::kFailed;
  std::unique_ptr<clca::tasks::Ranks> ranks;
  try {
    code = clca::cli::run_main(argc, argv, ranks);
  } catch (...) {  // no memory for a message either
    clca::cli::write_always("clca: error: out of memory\n");
    if (ranks) {
      clca::cli::end_all_ranks(code);
    }
  }
  ranks.reset();
  return clca::cli::finish_output(code);
}
