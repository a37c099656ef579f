#pragma once
// The commands; each sets `code` to the exit code when it has run. `ranks`: that carry it out
// together, if it is not one process alone.

namespace CLI {
class App;
}
namespace clca::tasks {
class Ranks;
}

namespace clca::cli {

void add_run_command(CLI::App& app, int& code);
void add_resume_command(CLI::App& app, int& code, tasks::Ranks* ranks);
void add_boltzmann_command(CLI::App& app, int& code, tasks::Ranks* ranks);
void add_sweep_command(CLI::App& app, int& code, tasks::Ranks* ranks);
void add_check_command(CLI::App& app, int& code);
void add_compare_command(CLI::App& app);
void add_diff_command(CLI::App& app, int& code);
void add_explain_command(CLI::App& app);
void add_export_command(CLI::App& app, int& code);
void add_plot_command(CLI::App& app);
void add_render_command(CLI::App& app, int& code);
void add_report_command(CLI::App& app);

}  // namespace clca::cli
