// clca report: a page about a run or a sweep.

#include <CLI/CLI.hpp>
#include <memory>

#include "clca/report/report.hpp"
#include "clca/text/message.hpp"
#include "cli/commands.hpp"
#include "cli/option_values.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ReportOptions {
  std::string run;
  std::string file;
  std::optional<std::size_t> max_frames;
};

void write_report(const ReportOptions& options) {
  const auto file = report::write_report(options.run, {.file = options.file,
                                                       .max_frames = options.max_frames,
                                                       .warning = [](const std::string& text) {
                                                         print_error("clca: warning: {}\n",
                                                                     text::printable(text));
                                                       }});
  print_out("{}\n", file.string());
}

}  // namespace

void add_report_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "report", "Write a page about a run or a sweep: measures, figures, pictures");
  auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->run, "Folder that a run or a sweep has left")->required();
  command->add_option("-o,--output", options->file, "Page to write [DIR/report.html]");
  command
      ->add_option("--max-frames", options->max_frames,
                   "Most pictures to step through [as many as keep the page below 20 MB]")
      ->check(whole_number(0, 100'000));
  command->callback([options] { write_report(*options); });
}

}  // namespace clca::cli
