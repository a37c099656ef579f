// clca compare: compares an automaton run with a Boltzmann run.

#include <memory>
#include <nlohmann/json.hpp>

#include "clca/compare/compare.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/text/message.hpp"
#include "cli/command.hpp"
#include "cli/option_values.hpp"
#include "cli/package.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

struct CompareOptions {
  std::string automaton;
  std::string boltzmann;
  std::string folder = "renders/comparison";
  compare::RunChoice choice;
};

int draw_figure(const std::filesystem::path& folder) {
  return run_package("plot", {{"only", {"comparison"}}}, {folder},
                     [&](const std::string& name, std::span<const std::uint8_t> bytes) {
                       store::OutputFolder(folder).write(name, bytes);
                     });
}

int compare_runs(const CompareOptions& options) {
  const compare::Comparison comparison =
      compare::comparison(options.automaton, options.boltzmann, options.choice);
  compare::write(comparison, options.folder);
  print_out("stage {} beside time {}\n", text::printable(comparison.stage), comparison.time);
  for (const compare::Distance& distance : compare::distances(comparison)) {
    print_out("{:40} D_H {:.3e}, floor {:.1e}\n", distance.name, distance.distance, distance.floor);
  }
  const int code = draw_figure(options.folder);
  print_out("{}\n", options.folder);
  return code;
}

}  // namespace

void add_compare_command(CommandLine& command_line) {
  Command command = command_line.command(
      "compare",
      "Energies of an automaton run beside those of a Boltzmann run, as tables and a figure");
  auto options = std::make_shared<CompareOptions>();
  command.option("AUTOMATON", &options->automaton, "Folder of a run with output.fields").required();
  command.option("BOLTZMANN", &options->boltzmann, "Folder of a run with output.histograms")
      .required();
  command.option("-o,--output", &options->folder, "Folder to write to").show_default();
  command
      .option("--stage", &options->choice.stage,
              "Stage of the automaton [the last with a fluctuation table]")
      .type("NAME");
  command.option("--time", &options->choice.time, "Time of the histogram [the latest]")
      .values(finite_number());
  command
      .option("--restitution", &options->choice.restitution,
              "Restitution to choose if the Boltzmann run has several")
      .values(finite_number());
  command.action([options] { return compare_runs(*options); });
}

}  // namespace clca::cli
