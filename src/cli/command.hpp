#pragma once
// The commands, as subcommands of CLI11, and how they end.

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/text/read.hpp"

namespace clca::tasks {
class Ranks;
}

namespace clca::cli {

// Exit codes.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;  // something failed, or pictures differ
inline constexpr int kWrongInput = 2;
inline constexpr int kTimeIsUp = 124;    // as of timeout(1)
inline constexpr int kSignalBase = 128;  // plus the number of the signal that interrupted the run

/// Sets the action of the command; `run` returns the exit code.
inline void set_action(CLI::App* command, std::function<int()> run) {
  command->callback([run = std::move(run)] {
    if (const int code = run(); code != kDone) {
      throw CLI::RuntimeError(code);
    }
  });
}

/// Completions of a command line: a line `files` if names of files are possible, too, else `words`;
/// then a line for each completion, with a tab and its description. `words` begin after the
/// program; the last one is incomplete and may be empty.
std::string completions(const CLI::App& program, const std::vector<std::string>& words);

/// Man pages of the program and of each command, by file name.
std::map<std::string, std::string> man_pages(const CLI::App& program);

/// Returns the result of `read`. Throws text::InputError in place of store::StoreError.
template <class Read>
auto read_as_input(Read&& read) {
  try {
    return std::forward<Read>(read)();
  } catch (const store::FolderLockError&) {
    throw;  // the folder is there, but cannot be written
  } catch (const store::StoreError& error) {
    throw text::InputError(error.what());
  }
}

// Each adds commands to the program. `ranks`: processes that carry one out together; null: one.

void add_run_commands(CLI::App& program, tasks::Ranks* ranks);  // run, resume, boltzmann
void add_sweep_command(CLI::App& program, tasks::Ranks* ranks);
void add_calibrate_command(CLI::App& program);
void add_check_command(CLI::App& program);
void add_compare_command(CLI::App& program);
void add_diff_command(CLI::App& program);
void add_explain_command(CLI::App& program);
void add_export_command(CLI::App& program);
void add_plot_command(CLI::App& program);
void add_render_command(CLI::App& program);
void add_report_command(CLI::App& program);
void add_scenes_command(CLI::App& program);

}  // namespace clca::cli
