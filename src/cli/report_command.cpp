// clca report: a page about a run or a sweep.

#include <memory>
#include <nlohmann/json.hpp>

#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct ReportOptions {
  std::string run;
  std::string file;
  std::optional<std::uint64_t> max_frames;
};

int write_report(const ReportOptions& options) {
  const auto write = [&](const std::string& name, std::span<const std::uint8_t> page) {
    const store::OutputFolder folder(options.run);
    if (options.file.empty()) {
      folder.write(name, page);
    } else {
      store::write_whole(options.file, page);
    }
    print_out("{}\n", options.file.empty() ? folder.path(name).string() : options.file);
  };
  nlohmann::json said = nlohmann::json::object();
  if (options.max_frames) {
    said["max_frames"] = *options.max_frames;
  }
  if (!options.file.empty()) {
    said["file"] = options.file;
  }
  return run_package("report", said, {options.run}, write);
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
  command.action([options] { return write_report(*options); });
}

}  // namespace clca::cli
