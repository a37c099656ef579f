// What shells need of the command line: completion and man pages.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "cli/command.hpp"

namespace clca::cli {

namespace {

constexpr std::string_view kHelp = "help";  // a command whose argument is a command

const CLI::App* find_command(const CLI::App& program, const std::string& name) {
  const auto commands = program.get_subcommands({});
  const auto found = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* command) {
    return command->get_name() == name;
  });
  return found != commands.end() ? *found : nullptr;
}

std::vector<const CLI::Option*> arguments_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

bool takes_value(const CLI::Option* option) {
  return option != nullptr && option->get_items_expected_max() > 0;
}

bool is_option(std::string_view word) {
  return word.size() > 1 && word.front() == '-';
}

/// The option or argument that the word after `words` is a value of; null: none.
const CLI::Option* open_option(const CLI::App& command, const std::vector<std::string>& words) {
  const CLI::Option* open = nullptr;
  std::size_t position = 0;  // among the arguments
  for (const std::string& word : words) {
    if (open != nullptr) {
      open = nullptr;
    } else if (is_option(word)) {
      const CLI::Option* option = command.get_option_no_throw(word);
      open = takes_value(option) ? option : nullptr;
    } else {
      ++position;
    }
  }
  const auto arguments = arguments_of(command);
  if (open != nullptr || arguments.empty()) {
    return open;
  }
  const bool repeats =
      arguments.back()->get_expected_max() == CLI::detail::expected_max_vector_size;
  position = repeats ? std::min(position, arguments.size() - 1) : position;
  return position < arguments.size() ? arguments[position] : nullptr;
}

/// TEXT is the type of options and arguments that do not say one.
bool names_file(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type == "TEXT" || type == "FILE" || type == "FOLDER";
}

std::vector<Candidate> names_of_options(const CLI::App& command) {
  std::vector<Candidate> names;
  for (const CLI::Option* option : options_of(command)) {
    const auto& longs = option->get_lnames();
    names.push_back({longs.empty() ? "-" + option->get_snames().front() : "--" + longs.front(),
                     option->get_description()});
  }
  return names;
}

std::vector<Candidate> names_of_commands(const CLI::App& program) {
  std::vector<Candidate> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back({command->get_name(), command->get_description()});
  }
  return names;
}

/// Those that begin so, one a line; of what they mean as much as a line of a terminal has.
std::string lines_of(const std::vector<Candidate>& candidates, const std::string& begun) {
  constexpr std::size_t kWidth = 80;
  std::string lines;
  for (const auto& [text, about] : candidates) {
    if (text.starts_with(begun)) {
      const std::size_t end = about.size() <= kWidth ? about.size() : about.rfind(' ', kWidth);
      lines += fmt::format("{}\t{}\n", text, about.substr(0, end));
    }
  }
  return lines;
}

/// For troff, which gives some characters a meaning, and others a typographic form.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    result += letter == '\\'                 ? "\\e"
              : letter == '-'                ? "\\-"
              : letter == '\''               ? "\\(aq"
              : letter == '.' && begins_line ? "\\&."
                                             : std::string(1, letter);
  }
  return result;
}

std::string section(std::string_view title, std::string_view text) {
  return text.empty() ? "" : fmt::format(".SH {}\n{}", title, text);
}

std::string entry(std::string_view term, std::string_view about) {
  return fmt::format(".TP\n.B {}\n{}\n", escaped(term), escaped(about));
}

std::string entries(const std::vector<const CLI::Option*>& options, bool are_arguments) {
  const CLI::Formatter formatter;
  std::string text;
  for (const CLI::Option* option : options) {
    text += entry(
        formatter.make_option_name(option, are_arguments) + formatter.make_option_opts(option),
        option->get_description());
  }
  return text;
}

std::string see_also(const CLI::App& program, const std::string& but) {
  std::string names = but.empty() ? "" : ".BR clca (1)";
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() != but && command->get_name() != kHelp) {
      names += fmt::format("{}.BR clca\\-{} (1)", names.empty() ? "" : ",\n",
                           escaped(command->get_name()));
    }
  }
  return names + "\n";
}

/// `name` as in `man NAME`.
std::string man_page(const CLI::App& program, const CLI::App& command, const std::string& name,
                     const std::string& version) {
  constexpr std::string_view kUsage = "Usage: ";
  const bool is_program = &program == &command;
  std::string call = is_program ? "clca" : "clca " + command.get_name();
  call = CLI::Formatter().make_usage(&command, call).substr(kUsage.size());
  std::string about = command.get_description();
  std::replace(about.begin(), about.end(), '\n', ' ');  // apropos reads one line
  std::string commands;
  if (is_program) {
    for (const auto& [text, what] : names_of_commands(program)) {
      commands += entry(text, what);
    }
  }
  return fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", escaped(name), version) +
         section("NAME", fmt::format("{} \\- {}\n", escaped(name), escaped(about))) +
         section("SYNOPSIS", escaped(call)) +
         section("ARGUMENTS", entries(arguments_of(command), true)) +
         section("OPTIONS", entries(options_of(command), false)) + section("COMMANDS", commands) +
         section("EXIT STATUS", escaped(command.get_footer()) + "\n") +
         section("SEE ALSO", see_also(program, is_program ? "" : command.get_name()));
}

}  // namespace

std::string CommandLine::completions(const std::vector<std::string>& words) const {
  const std::string begun = words.empty() ? "" : words.back();
  const bool is_help = words.size() == 2 && words.front() == kHelp;
  if ((words.size() < 2 || is_help) && !is_option(begun)) {
    return "words\n" + lines_of(names_of_commands(*app_), begun);
  }
  const CLI::App* command = words.size() < 2 ? app_.get() : find_command(*app_, words.front());
  if (command == nullptr) {
    return "words\n";
  }
  std::size_t value = 0;  // where it begins in `begun`
  const CLI::Option* option =
      words.size() < 2 ? nullptr : open_option(*command, {words.begin() + 1, words.end() - 1});
  if (is_option(begun) && (option == nullptr || option->get_positional())) {
    value = begun.find('=') + 1;
    if (value == 0) {
      return "words\n" + lines_of(names_of_options(*command), begun);
    }
    option = command->get_option_no_throw(begun.substr(0, value - 1));
  }
  if (option == nullptr) {
    return "words\n";
  }
  std::vector<Candidate> candidates;
  const auto known = state_.values.find(option);
  if (known != state_.values.end() && known->second.candidates) {
    candidates = known->second.candidates(begun.substr(value));
  }
  for (Candidate& candidate : candidates) {
    candidate.text = begun.substr(0, value) + candidate.text;
  }
  return (names_file(*option) ? "files\n" : "words\n") + lines_of(candidates, begun);
}

std::map<std::string, std::string> CommandLine::man_pages() const {
  std::map<std::string, std::string> pages = {{"clca.1", man_page(*app_, *app_, "clca", version_)}};
  for (const CLI::App* command : app_->get_subcommands({})) {
    if (command->get_name() != kHelp) {
      const std::string name = "clca-" + command->get_name();
      pages[name + ".1"] = man_page(*app_, *command, name, version_);
    }
  }
  return pages;
}

}  // namespace clca::cli
