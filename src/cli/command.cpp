#include "cli/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <string_view>

#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

constexpr std::size_t kShownCharacters = 400;  // of a message, which may hold a long argument

/// CLI11 would only say that a subcommand is required.
void check_command_name(const CLI::App& app, std::string_view given) {
  if (given.empty() || given.front() == '-') {
    return;
  }
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  if (std::find(names.begin(), names.end(), given) == names.end()) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw CLI::ParseError(
        fmt::format("no command {}{}", text::shown(given), text::suggestion(given, known)),
        CLI::ExitCodes::InvalidError);
  }
}

void parse(CLI::App& app, const std::vector<const char*>& arguments) {
  check_command_name(app, arguments.size() > 1 ? arguments[1] : "");
  if (std::any_of(arguments.begin(), arguments.end(),
                  [](const char* text) { return *text == '\0'; })) {
    throw CLI::ParseError("an argument is empty", CLI::ExitCodes::InvalidError);
  }
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::RequiredError&) {
    // CLI11 asks for a command first, even if it has seen an option that it does not know.
    const std::vector<std::string> unknown = app.remaining();
    if (app.get_subcommands().empty() && !unknown.empty() && unknown.front() != "--") {
      throw CLI::ExtrasError(unknown);
    }
    throw;
  }
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::type(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::values(const OptionValues& values) {
  option_->transform(CLI::Validator(values.read, values.shown));
  state_->values[option_] = values;
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::show_default(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::one_value() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::delimiter(char sign) {
  option_->delimiter(sign);
  return *this;
}

Option Command::option(const std::string& name, const OptionTarget& target,
                       const std::string& what) {
  return {std::visit(
              [&](const auto& to) {
                if constexpr (std::is_pointer_v<std::decay_t<decltype(to)>>) {
                  return app_->add_option(name, *to, what);
                } else {
                  return app_->add_option_function<std::string>(name, to, what);
                }
              },
              target),
          state_};
}

Option Command::flag(const std::string& name, bool* target, const std::string& what) {
  return {app_->add_flag(name, *target, what), state_};
}

void Command::remove_option(const std::string& name) {
  app_->remove_option(app_->get_option(name));
}

void Command::action(std::function<int()> run) {
  app_->callback([run = std::move(run), state = state_] { state->code = run(); });
}

CommandLine::CommandLine(const std::string& description, const std::string& version,
                         const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, "clca")), version_(version) {
  app_->set_version_flag("-V,--version", version);
  app_->require_subcommand(1);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

Command CommandLine::command(const std::string& name, const std::string& what) {
  return {app_->add_subcommand(name, what), &state_};
}

int CommandLine::run(const std::vector<const char*>& arguments) {
  try {
    parse(*app_, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      throw text::InputError(
          fmt::format("{} (see clca --help)", text::shortened(error.what(), kShownCharacters)));
    }
    std::ostringstream text;
    app_->exit(error, text, text);
    write_out(text.str());
    return static_cast<int>(ExitCode::done);
  }
  return state_.code;
}

}  // namespace clca::cli
