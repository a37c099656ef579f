#pragma once
// Commands and their options, by CLI11. Its header, which takes seconds to compile, is included in
// command.cpp and shell.cpp only.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "cli/option_values.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace clca::tasks {
class Ranks;
}

namespace clca::cli {

enum class ExitCode : int {
  done = 0,
  failed = 1,  ///< something failed, or pictures differ
  wrong_input = 2,
  time_is_up = 124,   ///< as of timeout(1)
  signal_base = 128,  ///< plus the number of the signal that interrupted the run
};

/// What commands leave beside what CLI11 knows.
struct CommandState {
  int code = 0;  ///< exit code of the command that has run
  std::map<const CLI::Option*, OptionValues> values;
};

/// Settings of an option or of an argument of a command.
class Option {
 public:
  Option(CLI::Option* option, CommandState* state) : option_(option), state_(state) {}

  Option& required();
  Option& type(const std::string& name);  ///< in the help, such as FILE
  Option& values(const OptionValues& values);
  Option& show_default();  ///< the present value, in the help
  Option& show_default(const std::string& text);
  Option& excludes(const Option& other);
  Option& one_value();  ///< of a list: one each time that the option is given
  Option& delimiter(char sign);

 private:
  CLI::Option* option_;
  CommandState* state_;
};

/// Where the value of an option goes. It has to stay there until the command has run.
using OptionTarget =
    std::variant<int*, std::uint64_t*, std::string*, std::filesystem::path*, std::optional<int>*,
                 std::optional<double>*, std::optional<std::uint64_t>*, std::optional<std::string>*,
                 std::vector<std::string>*, std::vector<std::filesystem::path>*,
                 std::function<void(const std::string&)>>;

template <class T>
using Words = std::vector<std::pair<std::string, T>>;

class Command {
 public:
  Command(CLI::App* app, CommandState* state) : app_(app), state_(state) {}

  /// An argument if the name does not begin with `-`.
  Option option(const std::string& name, const OptionTarget& target, const std::string& what);
  Option flag(const std::string& name, bool* target, const std::string& what);
  /// One of the words, each with the value that it stands for.
  template <class T>
  Option choice(const std::string& name, T* target, const std::type_identity_t<Words<T>>& words,
                const std::string& what, LetterCase letter_case = LetterCase::matters) {
    std::vector<std::string> known;
    for (const auto& [word, value] : words) {
      known.push_back(word);
    }
    const auto set = [target, words](const std::string& text) {
      *target = std::find_if(words.begin(), words.end(), [&](const auto& word) {
                  return word.first == text;
                })->second;
    };
    return option(name, set, what).values(one_of(known, letter_case));
  }
  void remove_option(const std::string& name);

  /// What the command does; `run` returns the exit code.
  void action(std::function<int()> run);

 private:
  CLI::App* app_;
  CommandState* state_;
};

class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& version,
              const std::string& footer);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  ~CommandLine();

  Command command(const std::string& name, const std::string& what);

  /// Runs the command that `arguments` name, or prints help; the first argument is the program.
  /// Returns the exit code. Throws text::InputError.
  int run(const std::vector<const char*>& arguments);

  /// What may follow on the command line: a line `files` if names of files may, too, else `words`;
  /// then one line for each candidate, with a tab and what it means. The last of `words`, which
  /// begin after the program, has been begun and may be empty.
  std::string completions(const std::vector<std::string>& words) const;

  /// Man pages of the program and of each command, by file name.
  std::map<std::string, std::string> man_pages() const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::string version_;
  CommandState state_;
};

// The commands. `ranks`: that carry one out together, if it is not one process alone.

void add_run_command(CommandLine& command_line);
void add_resume_command(CommandLine& command_line, tasks::Ranks* ranks);
void add_boltzmann_command(CommandLine& command_line, tasks::Ranks* ranks);
void add_sweep_command(CommandLine& command_line, tasks::Ranks* ranks);
void add_calibrate_command(CommandLine& command_line);
void add_check_command(CommandLine& command_line);
void add_compare_command(CommandLine& command_line);
void add_diff_command(CommandLine& command_line);
void add_explain_command(CommandLine& command_line);
void add_export_command(CommandLine& command_line);
void add_plot_command(CommandLine& command_line);
void add_render_command(CommandLine& command_line);
void add_report_command(CommandLine& command_line);
void add_scenes_command(CommandLine& command_line);

}  // namespace clca::cli
