// clca report: a page about a run.

#include <CLI/CLI.hpp>
#include <memory>

#include "clca/report/report.hpp"
#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/option_values.hpp"
#include "cli/terminal.hpp"
#include "scene/text.hpp"

namespace clca::cli {

namespace {

struct ReportOptions {
  std::string run;
  std::string file;
  std::optional<std::size_t> most_frames;
};

ExitCode report_or_complain(const ReportOptions& options) {
  try {
    const auto file = report::write_report(options.run, {.file = options.file,
                                                         .most_frames = options.most_frames,
                                                         .warning = [](const std::string& text) {
                                                           print_error("clca: warning: {}\n",
                                                                       scene::printable(text));
                                                         }});
    print_out("{}\n", file.string());
    return ExitCode::done;
  } catch (const report::InputError& error) {
    complain(error);
    return ExitCode::wrong_input;
  }
}

}  // namespace

void add_report_command(CLI::App& app, int& code) {
  CLI::App* command =
      app.add_subcommand("report", "Write a page about a run: measures, curves, maps, pictures");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->run, "Folder that a run has left")->required();
  command->add_option("-o,--output", options->file, "Page to write [DIR/report.html]");
  command
      ->add_option("--max-frames", options->most_frames,
                   "Most pictures to step through [as many as keep the page below 20 MB]")
      ->check(whole_number(0, 100'000));
  command->callback([options, &code] { code = static_cast<int>(report_or_complain(*options)); });
}

}  // namespace clca::cli
