#include "cli/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "clca/text/message.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

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
        fmt::format("no command {}{}", text::shown(given), text::suggestion(given, names)),
        CLI::ExitCodes::InvalidError);
  }
}

void parse(CLI::App& program, const std::vector<const char*>& arguments) {
  check_command_name(program, arguments.size() > 1 ? arguments[1] : "");
  if (std::ranges::any_of(arguments, [](const char* text) { return *text == '\0'; })) {
    throw CLI::ParseError("an argument is empty", CLI::ExitCodes::InvalidError);
  }
  try {
    program.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::RequiredError&) {
    // CLI11 asks for a command first, even if it has seen an option that it does not know.
    const std::vector<std::string> unknown = program.remaining();
    if (program.get_subcommands().empty() && !unknown.empty() && unknown.front() != "--") {
      throw CLI::ExtrasError(unknown);
    }
    throw;
  }
}

}  // namespace

void set_action(CLI::App* command, std::function<int()> run) {
  command->callback([run = std::move(run)] {
    if (const int code = run(); code != kDone) {
      throw CLI::RuntimeError(code);
    }
  });
}

int run(CLI::App& program, const std::vector<const char*>& arguments) {
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

}  // namespace clca::cli
