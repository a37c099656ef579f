#pragma once
// The commands. `ranks`: that carry one out together, if it is not one process alone.

namespace clca::tasks {
class Ranks;
}

namespace clca::cli {

class CommandLine;

void add_run_command(CommandLine& command_line);
void add_resume_command(CommandLine& command_line, tasks::Ranks* ranks);
void add_boltzmann_command(CommandLine& command_line, tasks::Ranks* ranks);
void add_sweep_command(CommandLine& command_line, tasks::Ranks* ranks);
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
