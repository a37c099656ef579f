// clca report: a page about a run or a sweep.

#include <memory>

#include "clca/report/report.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ReportOptions {
  std::string run;
  std::string file;
  std::optional<std::uint64_t> max_frames;
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

void add_report_command(CommandLine& command_line) {
  Command command = command_line.command(
      "report", "Write a page about a run or a sweep: measures, figures, pictures");
  auto options = std::make_shared<ReportOptions>();
  command.option("DIR", &options->run, "Folder that a run or a sweep has left").required();
  command.option("-o,--output", &options->file, "Page to write [DIR/report.html]");
  command
      .option("--max-frames", &options->max_frames,
              "Number of pictures in the page, at most [as many as keep the page below 20 MB]")
      .values(whole_number(0, 100'000));
  command.action([options] {
    write_report(*options);
    return static_cast<int>(ExitCode::done);
  });
}

}  // namespace clca::cli
