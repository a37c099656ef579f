// clca calibrate: values of keys with which scenes give what was measured. The Python package says
// which sweeps are needed and what follows from them; they run here.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "clca/store/output_folder.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/sweep_command.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct CalibrateOptions {
  std::string study;
  std::string folder;
  int jobs = machine_threads();
  std::optional<std::uint64_t> memory_limit;
  bool quiet = false;
};

SweepCommandOptions sweep_options(const nlohmann::json& sweep, const CalibrateOptions& options) {
  SweepCommandOptions result;
  result.scene.file = run::scene_file(sweep.at("scene"));
  result.scene.overrides = sweep.at("set");
  result.scene.memory_limit = options.memory_limit;
  result.variations = {sweep.at("vary")};
  result.seeds = sweep.at("seeds");
  result.folder = sweep.at("folder");
  result.jobs = options.jobs;
  result.quiet = options.quiet;
  return result;
}

int calibrate(const CalibrateOptions& options) {
  const std::string path =
      options.folder.empty()
          ? "renders/" + std::filesystem::path(options.study).stem().string() + "-calibration"
          : options.folder;
  const store::OutputFolder folder(path);
  folder.require_own();
  for (int step = 0;; ++step) {
    auto sweeps = nlohmann::json::array();
    int code = run_package("calibrate", {{"step", step}, {"study", options.study}}, {path},
                           [&](const std::string& name, std::span<const std::uint8_t> bytes) {
                             if (name == "sweeps.json") {
                               sweeps = nlohmann::json::parse(bytes);
                             } else {
                               folder.write(name, bytes);
                             }
                           });
    if (code != 0 || sweeps.empty()) {
      if (code == 0) {
        print_out("{}\n", path);
      }
      return code;
    }
    folder.make_own();
    for (const nlohmann::json& sweep : sweeps) {
      code = run_sweep(sweep_options(sweep, options));
      if (code != 0) {
        return code;
      }
    }
  }
}

}  // namespace

void add_calibrate_command(CommandLine& command_line) {
  Command command = command_line.command(
      "calibrate", "Find values of keys with which scenes give what was measured");
  auto options = std::make_shared<CalibrateOptions>();
  command
      .option("STUDY", &options->study,
              "File (YAML) with the tests, each a scene with its targets, and the keys to vary")
      .required();
  command.option("-o,--output", &options->folder,
                 "Folder to write to, and to continue in [renders/STUDY-NAME-calibration]");
  command
      .option("--jobs", &options->jobs,
              "Runs at a time, each with one thread; the result does not depend on it")
      .values(whole_number(1, 1024))
      .show_default();
  command
      .option("--memory-limit", &options->memory_limit,
              "Memory of all runs at a time, such as 4GiB [80 % of the free memory]")
      .type("SIZE")
      .values(byte_size());
  command.flag("--quiet", &options->quiet, "Print the answer, warnings and errors only");
  command.action([options] { return calibrate(*options); });
}

}  // namespace clca::cli
