// What shells need of the command line: completion and man pages.

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "clca/scene/format.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"

namespace clca::cli {

namespace {

using Candidates = std::vector<Completion>;

constexpr std::string_view kHelp = "help";  // a command whose argument is a command

std::vector<const CLI::Option*> arguments_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
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
      open = option != nullptr && option->get_items_expected_max() > 0 ? option : nullptr;
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
bool names_file(const std::string& type) {
  return type == "TEXT" || type == "FILE" || type == "FOLDER";
}

Candidates key_completions(const std::string& begun, const std::string& after_last) {
  Candidates candidates;
  for (const scene::KeySummary& key : scene::keys_with_prefix(begun)) {
    if (key.has_keys) {
      candidates.push_back({key.path + ".", key.about});
    }
    if (!key.has_keys || !scene::allowed_words(key.path).empty()) {
      candidates.push_back({key.path + after_last, key.about});
    }
  }
  return candidates;
}

/// `KEY=`, and after it the words that the key may have; several are separated by commas.
Candidates assignment_completions(const std::string& begun) {
  const std::size_t equals = begun.find('=');
  if (equals == std::string::npos) {
    return key_completions(begun, "=");
  }
  Candidates candidates;
  for (const std::string& word : scene::allowed_words(begun.substr(0, equals))) {
    candidates.push_back({begun.substr(0, begun.find_last_of("=,") + 1) + word});
  }
  return candidates;
}

/// The values of an option by its name or type: of `{png,pdf}` these words.
Candidates values_of(const CLI::Option& option, const std::string& begun) {
  const std::string type = option.get_type_name();
  const std::string& name = option.get_single_name();
  if (type.starts_with("KEY=")) {
    return assignment_completions(begun);
  }
  if (name == "KEY") {
    return key_completions(begun, "");
  }
  if (name == "SCENE" || name == "scene") {
    return installed_scenes();
  }
  Candidates words;
  const std::size_t open = type.find('{');
  if (open != std::string::npos) {
    for (const auto& word :
         CLI::detail::split(type.substr(open + 1, type.size() - open - 2), ',')) {
      words.push_back({word});
    }
  }
  return words;
}

Candidates names_of_options(const CLI::App& command) {
  Candidates names;
  for (const CLI::Option* option : options_of(command)) {
    const auto& longs = option->get_lnames();
    names.push_back({longs.empty() ? "-" + option->get_snames().front() : "--" + longs.front(),
                     option->get_description()});
  }
  return names;
}

Candidates names_of_commands(const CLI::App& program) {
  Candidates names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back({command->get_name(), command->get_description()});
  }
  return names;
}

/// Those that begin so, one a line; of what they mean as much as a line of a terminal has.
std::string lines_of(const Candidates& candidates, const std::string& begun,
                     const std::string& before = "") {
  constexpr std::size_t kWidth = 80;
  std::string lines;
  for (const auto& [text, about] : candidates) {
    if (text.starts_with(begun)) {
      const std::size_t end = about.size() <= kWidth ? about.size() : about.rfind(' ', kWidth);
      lines += fmt::format("{}{}\t{}\n", before, text, about.substr(0, end));
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

std::string man_section(std::string_view title, std::string_view text) {
  return text.empty() ? "" : fmt::format(".SH {}\n{}", title, text);
}

std::string man_entry(std::string_view term, std::string_view about) {
  return fmt::format(".TP\n.B {}\n{}\n", escaped(term), escaped(about));
}

std::string man_entries(const std::vector<const CLI::Option*>& options, bool are_arguments) {
  const CLI::Formatter formatter;
  std::string text;
  for (const CLI::Option* option : options) {
    text += man_entry(
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
std::string man_page(const CLI::App& program, const CLI::App& command, const std::string& name) {
  constexpr std::string_view kUsage = "Usage: ";
  const bool is_program = &program == &command;
  std::string call = is_program ? "clca" : "clca " + command.get_name();
  call = CLI::Formatter().make_usage(&command, call).substr(kUsage.size());
  std::string about = command.get_description();
  std::ranges::replace(about, '\n', ' ');  // apropos reads one line
  std::string commands;
  if (is_program) {
    for (const auto& [text, what] : names_of_commands(program)) {
      commands += man_entry(text, what);
    }
  }
  return fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", escaped(name), program.version()) +
         man_section("NAME", fmt::format("{} \\- {}\n", escaped(name), escaped(about))) +
         man_section("SYNOPSIS", escaped(call)) +
         man_section("ARGUMENTS", man_entries(arguments_of(command), true)) +
         man_section("OPTIONS", man_entries(options_of(command), false)) +
         man_section("COMMANDS", commands) +
         man_section("EXIT STATUS", escaped(command.get_footer()) + "\n") +
         man_section("SEE ALSO", see_also(program, is_program ? "" : command.get_name()));
}

}  // namespace

std::string completions(const CLI::App& program, const std::vector<std::string>& words) {
  const std::string begun = words.empty() ? "" : words.back();
  const bool is_help = words.size() == 2 && words.front() == kHelp;
  if ((words.size() < 2 || is_help) && !is_option(begun)) {
    return "words\n" + lines_of(names_of_commands(program), begun);
  }
  const auto commands = program.get_subcommands(
      [&](const CLI::App* command) { return command->get_name() == words.front(); });
  if (words.size() > 1 && commands.empty()) {
    return "words\n";
  }
  const CLI::App& command = words.size() < 2 ? program : *commands.front();
  const CLI::Option* option =
      words.size() < 2 ? nullptr : open_option(command, {words.begin() + 1, words.end() - 1});
  std::size_t value = 0;  // where it begins in `begun`
  if (is_option(begun) && (option == nullptr || option->get_positional())) {
    value = begun.find('=') + 1;
    if (value == 0) {
      return "words\n" + lines_of(names_of_options(command), begun);
    }
    option = command.get_option_no_throw(begun.substr(0, value - 1));
  }
  if (option == nullptr) {
    return "words\n";
  }
  const std::string text = begun.substr(value);
  return (names_file(option->get_type_name()) ? "files\n" : "words\n") +
         lines_of(values_of(*option, text), text, begun.substr(0, value));
}

std::map<std::string, std::string> man_pages(const CLI::App& program) {
  std::map<std::string, std::string> pages = {{"clca.1", man_page(program, program, "clca")}};
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() != kHelp) {
      const std::string name = "clca-" + command->get_name();
      pages[name + ".1"] = man_page(program, *command, name);
    }
  }
  return pages;
}

}  // namespace clca::cli
